#include "core/calibration/scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/odometry/differential_drive.h"

namespace odolab {
namespace {

TEST(Scale, MakesTheRobotBelieveWhatTheTapeSays) {
  // Real wheels are 1 % larger than nominal: after believed 3 m the robot stands at 3.03 m.
  const DifferentialDrive nominal;
  const auto c = calibrate_scale({3.0, 3.03, 0.003}, nominal);
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->scaling_error, 3.0 / 3.03, 1e-15);
  EXPECT_NEAR(c->corrected.wheel_radius_left_m, 0.075 * 1.01, 1e-15);
  const double turns_rad = 3.0 / nominal.wheel_radius_left_m;
  EXPECT_NEAR(dead_reckoned(Pose{}, turns_rad, turns_rad, c->corrected).x_m, 3.03, 1e-12);
  EXPECT_NEAR(c->scaling_error_stderr, 0.99e-3, 1e-5);  // 3 mm in 3 m: 0.1 %
  EXPECT_FALSE(calibrate_scale({3.0, 0.0, 0.001}, nominal));
}

TEST(Scale, KeepsTheRatioOfUnequalWheels) {
  DifferentialDrive nominal;
  nominal.wheel_radius_left_m = 0.074;
  const auto c = calibrate_scale({4.04, 4.0, 0.001}, nominal);
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->corrected.wheel_radius_left_m / c->corrected.wheel_radius_right_m, 0.074 / 0.075, 1e-15);
}

// Appendix A: with unequal wheels a nominal turn of 90 degrees becomes 90 degrees times mean over nominal diameter,
// whichever wheel is the larger one.
TEST(TurnOnTheSpot, TurnsByTheMeanDiameterOverTheNominalOne) {
  const DifferentialDrive nominal;
  const double wheel_rad = 0.25 * kPi * nominal.wheelbase_m / nominal.wheel_radius_left_m;  // Eq. A.7
  for (const double difference : {0.0, 0.002, -0.002}) {
    DifferentialDrive actual = nominal;
    actual.wheel_radius_left_m = 0.0755 - difference;
    actual.wheel_radius_right_m = 0.0755 + difference;
    for (const double way : {1.0, -1.0}) {
      const Pose end = dead_reckoned(Pose{}, -way * wheel_rad, way * wheel_rad, actual);
      EXPECT_NEAR(end.heading_rad, way * 0.5 * kPi * 0.0755 / 0.075, 1e-14);  // Eq. A.16
      // The centre circles the point that divides the wheelbase as the radii do: b (rR - rL) / (2 (rR + rL)) away.
      const double arm = 0.5 * actual.wheelbase_m * 2 * difference / (2 * 0.0755);
      EXPECT_NEAR(length(end.position()), std::abs(arm * end.heading_rad), 1e-12);
    }
  }
}

}  // namespace
}  // namespace odolab
