#include "core/calibration/slow_counts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

constexpr double kSlowCount_rad = 0.02, kSlowPeriod_s = 0.005;

std::vector<WheelSample> counted_readings(double (*turned_rad)(double), double duration_s) {
  std::vector<WheelSample> readings;
  for (double t = 0.0; t < duration_s; t += kSlowPeriod_s) {
    const double read = kSlowCount_rad * std::floor(turned_rad(t) / kSlowCount_rad);
    readings.push_back({t, read, -read});
  }
  return readings;
}

// The mean remainder, which any whole count hides: half a count.
constexpr double kHidden_rad = 0.5 * kSlowCount_rad;

TEST(SlowCounts, AWheelSlowerThanItsReadingsIsKnownBetterThanToACount) {
  // 40 counts a second, read 200 times: an edge is known to half a period, 0.1 count.
  const auto slow = [](double t) { return 0.8 * t; };
  const std::vector<WheelSample> drawn = with_slow_counts_drawn(counted_readings(slow, 2.0), kSlowCount_rad);
  for (const WheelSample& w : drawn) {
    if (w.time_s < 0.1 || w.time_s > 1.9) continue;
    EXPECT_NEAR(w.left_rad, slow(w.time_s) - kHidden_rad, 0.11 * kSlowCount_rad) << w.time_s;
    EXPECT_EQ(w.right_rad, -w.left_rad);
  }
}

TEST(SlowCounts, AWheelThatWaitsHalfASecondForEachCountGoesOnBetween) {
  const auto slow = [](double t) { return 2.0 * kSlowCount_rad * t; };
  for (const WheelSample& w : with_slow_counts_drawn(counted_readings(slow, 4.0), kSlowCount_rad)) {
    if (w.time_s < 0.6 || w.time_s > 3.4) continue;
    EXPECT_NEAR(w.left_rad, slow(w.time_s) - kHidden_rad, 0.02 * kSlowCount_rad) << w.time_s;  // half a period's way
  }
}

TEST(SlowCounts, AFastWheelAndOneThatRestsAreLeftAsTheyWereRead) {
  const auto fast = [](double t) { return 8.3 * t; };                     // two counts a reading
  const auto stops = [](double t) { return t < 1.0 ? 0.03 * t : 0.03; };  // one count, then none
  const auto turns_back = [](double t) { return 0.03 - 0.02 * std::abs(t - 1.0); };
  for (const auto turned : {+fast, +stops, +turns_back}) {
    const std::vector<WheelSample> read = counted_readings(turned, 2.0),
                                   drawn = with_slow_counts_drawn(read, kSlowCount_rad);
    ASSERT_EQ(drawn.size(), read.size());
    for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(drawn[i].left_rad, read[i].left_rad) << read[i].time_s;
  }
}

}  // namespace
}  // namespace odolab
