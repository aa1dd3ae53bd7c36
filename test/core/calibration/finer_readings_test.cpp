#include "core/calibration/finer_readings.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace odolab {
namespace {

std::vector<WheelSample> read_every(double period_s, double (*rad)(double)) {
  std::vector<WheelSample> wheels;
  for (int i = 0; i <= 20; ++i) wheels.push_back({period_s * i, rad(period_s * i), -rad(period_s * i)});
  return wheels;
}

double speeding_up(double t) { return 1.5 * t + 2.0 * t * t; }

TEST(FinerReadings, LieOnTheParabolaOfAWheelThatSpeedsUpEvenly) {
  const std::vector<WheelSample> wheels = read_every(0.1, speeding_up), finer = finer_readings(wheels);
  EXPECT_EQ(finer.size(), 4 * (wheels.size() - 1) + 1);
  // But for the first interval and the last, whose ends have one neighbour each: a straight line is off by 5 mrad.
  for (const WheelSample& w : finer)
    if (w.time_s > 0.1 && w.time_s < 1.9) {
      EXPECT_NEAR(w.left_rad, speeding_up(w.time_s), 1e-12) << w.time_s;
      EXPECT_NEAR(w.right_rad, -speeding_up(w.time_s), 1e-12) << w.time_s;
    }
}

TEST(FinerReadings, AreThoseThatWereReadWhereTheyComeOften) {
  EXPECT_EQ(finer_readings(read_every(0.02, speeding_up)).size(), 21u);
}

TEST(FinerReadings, PutNothingIntoAGap) {
  std::vector<WheelSample> wheels = read_every(0.1, speeding_up);
  wheels.erase(wheels.begin() + 8, wheels.begin() + 13);
  for (const WheelSample& w : finer_readings(wheels)) EXPECT_TRUE(w.time_s < 0.7 + 1e-9 || w.time_s > 1.3 - 1e-9);
}

}  // namespace
}  // namespace odolab
