#include "core/base/parallel.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace odolab {

int parallel_for(int count, const std::function<void(int, const std::atomic<bool>&)>& work,
                 const std::function<void(int)>& done, const Progress& progress) {
  if (count <= 0) return 0;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<char> finished(static_cast<std::size_t>(count), 0);
  std::atomic<int> next{0};
  std::atomic<bool> stopped{false};
  const auto worker = [&] {
    for (int i = next++; i < count && !stopped; i = next++) {
      work(i, stopped);
      if (stopped) return;
      const std::lock_guard<std::mutex> lock(mutex);
      finished[static_cast<std::size_t>(i)] = 1;
      changed.notify_one();
    }
  };
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::vector<std::thread> threads;
  if (!done && !progress) {  // nobody waits for a part: the caller works too
    for (int t = 1; t < std::min(cores, count); ++t) threads.emplace_back(worker);
    worker();
    for (std::thread& thread : threads) thread.join();
    return count;
  }
  for (int t = 0; t < std::min(cores, count); ++t) threads.emplace_back(worker);
  int in_order = 0;
  while (in_order < count && !stopped) {
    {
      std::unique_lock<std::mutex> lock(mutex);
      const bool ready = changed.wait_for(lock, std::chrono::milliseconds(100),
                                          [&] { return finished[static_cast<std::size_t>(in_order)] != 0; });
      if (!ready) {
        lock.unlock();
        if (!goes_on(progress, static_cast<double>(in_order) / count)) stopped = true;
        continue;
      }
    }
    if (done) done(in_order);
    ++in_order;
    if (!goes_on(progress, static_cast<double>(in_order) / count)) stopped = true;
  }
  for (std::thread& thread : threads) thread.join();
  return in_order;
}

int parallel_for(int count, const std::function<void(int)>& work, const std::function<void(int)>& done,
                 const Progress& progress) {
  return parallel_for(
      count, [&work](int i, const std::atomic<bool>&) { work(i); }, done, progress);
}

}  // namespace odolab
