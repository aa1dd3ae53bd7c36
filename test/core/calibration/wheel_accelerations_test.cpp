#include "core/calibration/wheel_accelerations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace odolab {
namespace {

constexpr double kWheelPeriod_s = 0.02;

std::vector<WheelSample> read_of(double duration_s, double count_rad, double (*turned_rad)(double)) {
  std::vector<WheelSample> readings;
  for (double t = 0.0; t < duration_s; t += kWheelPeriod_s) {
    const double rad = turned_rad(t);
    readings.push_back({t, count_rad * std::floor(rad / count_rad), rad});
  }
  return readings;
}

TEST(WheelAccelerations, OfAConstantAccelerationAreThatAccelerationUpToBothEnds) {
  const auto readings = read_of(4.0, 1e-3, [](double t) { return 1.5 * t * t; });
  for (const WheelAcceleration& a : wheel_accelerations(readings)) EXPECT_NEAR(a.right_radps2, 3.0, 1e-9);
}

// Speed is what accelerations add up to: of a wheel that reaches 5 rad/s in 0.3 s.
TEST(WheelAccelerations, OfAQuickStartAddUpToTheSpeedReached) {
  const auto readings = read_of(4.0, 2e-3, [](double t) {
    const double on = std::clamp(t - 2.0, 0.0, 0.3);
    return 0.5 * on * on * 5.0 / 0.3 + (t > 2.3 ? 5.0 * (t - 2.3) : 0.0);
  });
  double left = 0.0, right = 0.0, late = 0.0;
  const auto accelerations = wheel_accelerations(readings);
  for (std::size_t i = 0; i < accelerations.size(); ++i) {
    left += kWheelPeriod_s * accelerations[i].left_radps2;
    right += kWheelPeriod_s * accelerations[i].right_radps2;
    if (std::abs(kWheelPeriod_s * static_cast<double>(i) - 2.15) > 0.35)
      late += std::abs(accelerations[i].right_radps2);
  }
  EXPECT_NEAR(right, 5.0, 0.01 * 5.0);
  EXPECT_NEAR(left, 5.0, 0.02 * 5.0);
  EXPECT_NEAR(late, 0.0, 1e-6);  // further away than the shortest reach and half the start, 0.35 s
}

// A count of 0.05 rad on a wheel that turns to and fro: the variance of what remains against the acceleration's own.
TEST(WheelAccelerations, OfCoarseCountsAreSmoothedUntilTheirTrembleIsAThousandth) {
  const auto readings = read_of(60.0, 0.02, [](double t) { return 8.0 * std::sin(0.9 * t) + 1.3 * t; });
  double off = 0.0, all = 0.0;
  const auto accelerations = wheel_accelerations(readings);
  for (std::size_t i = 0; i < accelerations.size(); ++i) {
    const double truth = -8.0 * 0.81 * std::sin(0.9 * kWheelPeriod_s * (static_cast<double>(i) + 0.5));
    const double by = accelerations[i].left_radps2 - truth;
    off += by * by;
    all += truth * truth;
  }
  EXPECT_LT(off / all, 2e-3);  // and as much again where it is rounded the same way for a while, at rest
}

TEST(WheelAccelerations, OfFewReadingsOrOneStampAreNone) {
  EXPECT_TRUE(wheel_accelerations({}).empty());
  for (const WheelAcceleration& a : wheel_accelerations({{0.0, 0.0, 0.0}, {0.1, 1.0, 1.0}, {0.2, 3.0, 3.0}}))
    EXPECT_EQ(a.left_radps2, 0.0);
  for (const WheelAcceleration& a : wheel_accelerations(std::vector<WheelSample>(8, {1.0, 0.5, 0.5})))
    EXPECT_EQ(a.left_radps2, 0.0);
}

}  // namespace
}  // namespace odolab
