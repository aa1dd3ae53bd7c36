#include "physics/self_calibration.h"

#include <gtest/gtest.h>

#include "physics/experiments/report_labmates.h"

namespace odolab {
namespace {

// Both errors, a wrong scale, and a smooth floor: what is left comes from the sonar, the tape and the encoders alone.
Scenario labmate_in_its_corner() {
  Scenario robot = labmate_on_report_squares(1.002, 1.006);
  robot.floor.roughness = {};
  robot.path = SquarePath{1.0, false};
  robot.step_s = 0.004;
  robot.actual.wheel_radius_left_m *= 1.004;
  robot.actual.wheel_radius_right_m *= 1.004;
  return robot;
}

TEST(SelfCalibration, FindsRadiiAndWheelbaseWithoutBeingPutBack) {
  const Scenario robot = labmate_in_its_corner();
  SelfCalibrationPlan plan;
  plan.runs_each_way = 3;
  plan.tape_accuracy_m = 0.0;
  const SelfCalibration self = *self_calibrate(robot, plan, 3);
  ASSERT_FALSE(self.lost);
  ASSERT_GE(self.rounds.size(), 2u);
  EXPECT_TRUE(self.rounds.front().calibration.has_value());
  EXPECT_FALSE(self.rounds.back().calibration.has_value());  // the last round only confirms
  // 2 mm of sonar at both ends of 3 squares each way: 1.6 mm in each of four coordinates, 0.41 mrad in alpha and beta
  // (Eqs. 6.22, 6.26, L = 1 m); that is 140 ppm of the wheels' ratio and 260 ppm of the wheelbase. Three times that.
  const double ratio = self.found.wheel_radius_right_m / self.found.wheel_radius_left_m;
  EXPECT_NEAR(ratio, 1.002, 4.2e-4);
  EXPECT_NEAR(self.found.wheelbase_m, robot.actual.wheelbase_m, 0.340 * 7.8e-4);
  // The tape is read along the chord of a slightly curved drive, and an encoder count is 0.2 mm of 4 m.
  EXPECT_NEAR(self.found.wheel_radius_left_m / robot.actual.wheel_radius_left_m, 1.0, 3e-4);
  // Eqs. 6.19, 6.20: a square of 1 m returns within 75 mm with these errors, and the way home is shorter than it.
  EXPECT_LT(self.farthest_from_corner_m, 0.1);
}

TEST(SelfCalibration, LeavesTheScaleWhereNobodyMeasuresIt) {
  const Scenario robot = labmate_in_its_corner();
  SelfCalibrationPlan plan;
  plan.runs_each_way = 2;
  plan.most_rounds = 2;
  plan.tape_drive_m = 0.0;
  const SelfCalibration self = *self_calibrate(robot, plan, 4);
  EXPECT_FALSE(self.scale.has_value());
  const double mean_m = 0.5 * (self.found.wheel_radius_left_m + self.found.wheel_radius_right_m);
  EXPECT_NEAR(mean_m, 0.075, 1e-9);  // Eq. 6.30: the mean diameter stays
}

TEST(SelfCalibration, StopsWhenTold) {
  EXPECT_FALSE(self_calibrate(labmate_in_its_corner(), {}, 1, [](double) { return false; }).has_value());
}

}  // namespace
}  // namespace odolab
