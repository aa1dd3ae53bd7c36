#include "core/calibration/smoothed_readings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

constexpr double kSmoothedCount_rad = 0.00628;  // 1000 to a turn

// A wheel that speeds up from rest, goes on evenly and stops, read 100 times a second; the right one backward.
double turned_rad(double time_s) {
  const double t = std::max(0.0, time_s - 1.0);
  if (t < 1.0) return 0.75 * t * t;
  if (t < 4.0) return 0.75 + 1.5 * (t - 1.0);
  const double u = std::min(t - 4.0, 1.0);
  return 5.25 + 1.5 * u - 0.75 * u * u;
}

std::vector<WheelSample> readings() {
  std::vector<WheelSample> all;
  for (int i = 0; i <= 700; ++i) {
    const double t = 0.01 * i, rad = turned_rad(t);
    all.push_back({t, kSmoothedCount_rad * std::floor(rad / kSmoothedCount_rad),
                   kSmoothedCount_rad * std::floor(-rad / kSmoothedCount_rad)});
  }
  return all;
}

// Read 20 times a second a window has five readings to either side, the last at its very end, whenever the log began.
TEST(SmoothedReadings, AreTheSameWheneverTheLogBegan) {
  const auto smoothed_of_log = [](double begins_s) {
    std::vector<WheelSample> all;
    for (int i = 0; i <= 140; ++i) {
      const double counts = std::floor(turned_rad(0.05 * i) / kSmoothedCount_rad);
      all.push_back({std::round(1e3 * (begins_s + 0.05 * i)) / 1e3, kSmoothedCount_rad * counts, 0.0});
    }
    return smoothed(all);
  };
  const std::vector<WheelSample> at_once = smoothed_of_log(0.0);
  for (const double begins_s : {2.05, 50.006, 1000.03, 1.7e9}) {
    const std::vector<WheelSample> later = smoothed_of_log(begins_s);
    for (std::size_t i = 0; i < later.size(); ++i)
      ASSERT_NEAR(later[i].left_rad, at_once[i].left_rad, 0.01 * kSmoothedCount_rad) << begins_s << " at " << i;
  }
}

TEST(SmoothedReadings, KeepTimesAndEnds) {
  const std::vector<WheelSample> raw = readings(), smooth = smoothed(raw);
  ASSERT_EQ(smooth.size(), raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) EXPECT_EQ(smooth[i].time_s, raw[i].time_s);
  EXPECT_EQ(smooth.front().left_rad, raw.front().left_rad);
  EXPECT_NEAR(smooth.back().left_rad, raw.back().left_rad, 1e-12);  // at rest: rounding of sums
  EXPECT_NEAR(smooth.back().right_rad, raw.back().right_rad, 1e-12);
}

TEST(SmoothedReadings, FollowAWheelThatSpeedsUpWhereALineWouldNot) {
  std::vector<WheelSample> exact = readings();
  for (WheelSample& s : exact) s.left_rad = turned_rad(s.time_s);
  const std::vector<WheelSample> smooth = smoothed(exact);
  const double of_a_line = 1.5 * 0.25 * 0.25 / 6.0;  // a h^2 / 6, the mean of a parabola over its window
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double t = exact[i].time_s, off = std::abs(smooth[i].left_rad - turned_rad(t));
    if (t > 1.25 && t < 1.75) {
      EXPECT_LT(off, 1e-9) << t;  // even acceleration: rounding of sums
    }
    EXPECT_LT(off, 0.1 * of_a_line) << t;  // and where it begins and ends: 0.064
  }
}

TEST(SmoothedReadings, FollowAnEvenWheelToATenthOfACount) {
  const std::vector<WheelSample> smooth = smoothed(readings());
  // Rounding down is half a count low in the mean. 16 steps of the saw are averaged: 1/16 of a count at most, twice
  // that where they are not whole.
  for (const WheelSample& s : smooth)
    if (s.time_s > 2.5 && s.time_s < 4.5) {
      EXPECT_NEAR(s.left_rad + 0.5 * kSmoothedCount_rad, turned_rad(s.time_s), 0.1 * kSmoothedCount_rad);
    }
}

TEST(SmoothedReadings, DifferencesHardlyKnowTheRoundingErrorOfTheReadings) {
  const std::vector<WheelSample> raw = readings(), smooth = smoothed(raw);
  double with_raw = 0.0, with_smooth = 0.0;
  for (std::size_t i = 0; i + 1 < raw.size(); ++i) {
    const double wrong =
        (raw[i + 1].left_rad - turned_rad(raw[i + 1].time_s)) - (raw[i].left_rad - turned_rad(raw[i].time_s));
    with_raw += wrong * (raw[i + 1].left_rad - raw[i].left_rad);
    with_smooth += wrong * (smooth[i + 1].left_rad - smooth[i].left_rad);
  }
  EXPECT_GT(with_raw, 0.0);
  EXPECT_LT(std::abs(with_smooth), 0.05 * with_raw);  // one in fifty readings, and chance
}

TEST(SmoothedReadings, AreTheReadingsWhereTheseAreFarApart) {
  std::vector<WheelSample> raw;
  for (int i = 0; i < 10; ++i) raw.push_back({0.5 * i, 0.1 * i * i, -0.2 * i});
  const std::vector<WheelSample> same = smoothed(raw);
  for (std::size_t i = 0; i < raw.size(); ++i) EXPECT_EQ(same[i].left_rad, raw[i].left_rad);
}

}  // namespace
}  // namespace odolab
