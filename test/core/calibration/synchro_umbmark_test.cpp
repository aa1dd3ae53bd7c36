#include "core/calibration/synchro_umbmark.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

constexpr double kSide_m = 4.0;

// A K2A with all four errors, small enough that the equations of first order can be told from wrong ones.
SynchroDrive faulty(double size) {
  SynchroDrive drive;
  drive.steering_ratio = 1.0 + 0.002 * size;
  drive.base_turn_rad_per_m = 0.0007 * size;
  drive.base_turn_cos_rad_per_m = -0.003 * size;
  drive.base_turn_sin_rad_per_m = 0.002 * size;
  return drive;
}

UmbmarkRuns squares_of(const SynchroDrive& actual, const SynchroDrive& believed) {
  return {kSide_m,
          {synchro_square_return_error(actual, believed, kSide_m, true)},
          {synchro_square_return_error(actual, believed, kSide_m, false)}};
}

TEST(SynchroUmbmark, ReturnsToWhereTheEquationsOfFirstOrderSay) {
  const double size = 0.01;
  const SynchroDrive actual = faulty(size);
  const double a = 0.5 * kPi * (1.0 - 1.0 / actual.steering_ratio), c = actual.base_turn_rad_per_m;
  const double A = actual.base_turn_cos_rad_per_m, B = actual.base_turn_sin_rad_per_m, L = kSide_m;
  const UmbmarkRuns runs = squares_of(actual, SynchroDrive{});
  const double second_order_m = 1e-5;  // errors of 1e-4 rad, squared, times a dozen metres, with room
  EXPECT_NEAR(runs.clockwise[0].x_m, -2.0 * L * a - 2.0 * L * L * c + L * L * A, second_order_m);
  EXPECT_NEAR(runs.clockwise[0].y_m, -2.0 * L * a - 2.0 * L * L * c + L * L * B, second_order_m);
  EXPECT_NEAR(runs.counter_clockwise[0].x_m, -2.0 * L * a + 2.0 * L * L * c - L * L * A, second_order_m);
  EXPECT_NEAR(runs.counter_clockwise[0].y_m, 2.0 * L * a - 2.0 * L * L * c - L * L * B, second_order_m);
}

TEST(SynchroUmbmark, FindsAllFourErrorsFromFourCoordinates) {
  const SynchroDrive actual = faulty(1.0);
  const SynchroCalibration found = *calibrate_synchro(squares_of(actual, SynchroDrive{}), SynchroDrive{});
  EXPECT_NEAR(found.corrected.steering_ratio, actual.steering_ratio, 1e-9);  // exact path, no noise
  EXPECT_NEAR(found.corrected.base_turn_rad_per_m, actual.base_turn_rad_per_m, 1e-9);
  EXPECT_NEAR(found.corrected.base_turn_cos_rad_per_m, actual.base_turn_cos_rad_per_m, 1e-9);
  EXPECT_NEAR(found.corrected.base_turn_sin_rad_per_m, actual.base_turn_sin_rad_per_m, 1e-9);
  // And from a belief that is half right already.
  const SynchroCalibration again = *calibrate_synchro(squares_of(actual, faulty(0.5)), faulty(0.5));
  EXPECT_NEAR(again.corrected.base_turn_cos_rad_per_m, actual.base_turn_cos_rad_per_m, 1e-9);
  EXPECT_NEAR(again.corrected.steering_ratio, actual.steering_ratio, 1e-9);
}

// Unequal wheels give the two clusters of a differential drive's type B in x, and none of its y: the report's
// calibration, which has no other word for them, would make the robot curve.
TEST(SynchroUmbmark, UnequalWheelsLookLikeTypeBInOneCoordinateAlone) {
  SynchroDrive actual;
  actual.base_turn_cos_rad_per_m = 0.003;
  const UmbmarkRuns runs = squares_of(actual, SynchroDrive{});
  EXPECT_NEAR(runs.clockwise[0].x_m, kSide_m * kSide_m * 0.003, 0.002);  // 48 mm; second order: 4 m (12 mrad)^2, twice
  EXPECT_NEAR(runs.counter_clockwise[0].x_m, -kSide_m * kSide_m * 0.003, 0.002);
  EXPECT_NEAR(runs.clockwise[0].y_m, 0.0, 0.002);
  EXPECT_NEAR(runs.clockwise[0].heading_rad, 0.0, 1e-4);  // what a side turns, the opposite one turns back
  const UmbmarkCalibration by_report = *calibrate_umbmark(runs, DifferentialDrive{});
  EXPECT_GT(by_report.residual_m, 0.02);  // half of the 48 mm has no place in alpha and beta
}

TEST(SynchroUmbmark, SaysNothingWithoutRunsInBothDirections) {
  UmbmarkRuns runs = squares_of(faulty(1.0), SynchroDrive{});
  runs.clockwise.clear();
  EXPECT_FALSE(calibrate_synchro(runs, SynchroDrive{}).has_value());
}

// It had been 0 of each, and less than it is where one direction had more.
TEST(SynchroUmbmark, DoesNotSayHowUncertainItIsWhereADirectionHasOneRun) {
  UmbmarkRuns runs = squares_of(faulty(1.0), SynchroDrive{});
  const auto add_beside = [](std::vector<ReturnError>& of) {
    of.push_back({of[0].x_m + 0.01, of[0].y_m - 0.01, of[0].heading_rad});
  };
  EXPECT_FALSE(calibrate_synchro(runs, SynchroDrive{})->standard_errors);
  add_beside(runs.clockwise);
  EXPECT_FALSE(calibrate_synchro(runs, SynchroDrive{})->standard_errors);
  add_beside(runs.counter_clockwise);
  const auto known = calibrate_synchro(runs, SynchroDrive{})->standard_errors;
  ASSERT_TRUE(known);
  // Eqs. 1: of a sum of two x with 5 mm each.
  EXPECT_NEAR((*known)[0], std::sqrt(2.0) * 0.005 / (4.0 * kSide_m), 1e-5);
}

}  // namespace
}  // namespace odolab
