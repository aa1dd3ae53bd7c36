#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace odolab {
namespace {

TEST(Parallel, ReportsInOrderWhateverFinishesFirst) {
  std::vector<int> squares(50), order;
  const int done = parallel_for(
      50, [&](int i, const std::atomic<bool>&) { squares[static_cast<std::size_t>(i)] = i * i; },
      [&](int i) { order.push_back(i); });
  EXPECT_EQ(done, 50);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
    EXPECT_EQ(squares[static_cast<std::size_t>(i)], i * i);
  }
}

TEST(Parallel, StopsWorkThatWouldNeverEnd) {
  const int done = parallel_for(
      4,
      [](int, const std::atomic<bool>& stopped) {
        while (!stopped) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      },
      {}, [](double) { return false; });
  EXPECT_EQ(done, 0);
}

TEST(Parallel, DoesEachPieceOnceWhereWorkHandsOutWorkAndSeveralAskAtOnce) {
  constexpr int kOuter = 40, kInner = 30;
  const auto ask = [](std::vector<std::atomic<int>>& times) {
    parallel_for(kOuter, [&](int i) {
      parallel_for(kInner, [&](int j) { ++times[static_cast<std::size_t>(kInner * i + j)]; });
    });
  };
  std::vector<std::atomic<int>> here(kOuter * kInner), there(kOuter * kInner);
  std::thread other([&] { ask(there); });
  ask(here);
  other.join();
  for (const auto* times : {&here, &there})
    for (const std::atomic<int>& t : *times) EXPECT_EQ(t, 1);
}

}  // namespace
}  // namespace odolab
