#include "core/calibration/umbmark.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/odometry/differential_drive.h"

namespace odolab {
namespace {

// The robot drives the square by its own dead reckoning: it rolls its wheels as its belief says and ends where its true
// wheels take it. Arcs in closed form, so nothing here is approximate.
Pose driven_square(const DifferentialDrive& believed, const DifferentialDrive& actual, double side_m, bool clockwise) {
  Pose pose;
  const auto roll = [&](double left_rad, double right_rad) {
    const double left_m = actual.wheel_radius_left_m * left_rad, right_m = actual.wheel_radius_right_m * right_rad;
    const double turn = (right_m - left_m) / actual.wheelbase_m, way = 0.5 * (left_m + right_m);
    const double chord = std::abs(turn) < 1e-12 ? way : way * std::sin(0.5 * turn) / (0.5 * turn);
    pose = advanced(pose, chord, turn);
  };
  for (int i = 0; i < 4; ++i) {
    roll(side_m / believed.wheel_radius_left_m, side_m / believed.wheel_radius_right_m);
    const double arc_m = (clockwise ? -0.25 : 0.25) * kPi * believed.wheelbase_m;
    roll(-arc_m / believed.wheel_radius_left_m, arc_m / believed.wheel_radius_right_m);
  }
  return pose;
}

UmbmarkRuns square_runs(const DifferentialDrive& believed, const DifferentialDrive& actual, double side_m = 4.0) {
  UmbmarkRuns runs;
  runs.side_m = side_m;
  const Pose cw = driven_square(believed, actual, side_m, true), ccw = driven_square(believed, actual, side_m, false);
  runs.clockwise = {{cw.x_m, cw.y_m, wrapped(cw.heading_rad)}};
  runs.counter_clockwise = {{ccw.x_m, ccw.y_m, wrapped(ccw.heading_rad)}};
  return runs;
}

// Radii whose ratio is Ed and whose mean is the nominal one, and a wheelbase Eb times the nominal.
DifferentialDrive machine(double ratio, double wheelbase_ratio) {
  DifferentialDrive d;
  const double mean = d.wheel_radius_left_m;
  d.wheel_radius_left_m = mean * 2.0 / (ratio + 1.0);
  d.wheel_radius_right_m = mean * 2.0 / (1.0 / ratio + 1.0);
  d.wheelbase_m *= wheelbase_ratio;
  return d;
}

TEST(Umbmark, AgreesWithTheReportsFirstOrderTerms) {
  const double side = 4.0, tiny = 1e-5;
  for (const TypeErrors e : {TypeErrors{tiny, 0.0}, TypeErrors{0.0, tiny}, TypeErrors{tiny, -0.4 * tiny}}) {
    const ReturnError cw = square_return_error(e, side, true, 0.34), ccw = square_return_error(e, side, false, 0.34);
    const double second = 100.0 * side * tiny * tiny;                      // the next order
    EXPECT_NEAR(cw.x_m, -2 * side * (e.alpha_rad + e.beta_rad), second);   // Eq. 6.19
    EXPECT_NEAR(ccw.x_m, -2 * side * (e.alpha_rad - e.beta_rad), second);  // Eq. 6.20
    EXPECT_NEAR(cw.y_m, -2 * side * (e.alpha_rad + e.beta_rad), second);   // Eqs. 6.10b, 6.18b
    EXPECT_NEAR(ccw.y_m, 2 * side * (e.alpha_rad - e.beta_rad), second);   // Eq. 6.14b and its type A
    EXPECT_NEAR(cw.heading_rad, 4 * (e.alpha_rad + e.beta_rad), second);
    EXPECT_NEAR(ccw.heading_rad, -4 * (e.alpha_rad - e.beta_rad), second);
  }
}

TEST(Umbmark, PredictsTheReturnOfARobotThatDrivesByItsOwnBelief) {
  const DifferentialDrive believed, actual = machine(1.004, 1.02);
  const UmbmarkRuns runs = square_runs(believed, actual);
  const double mean = 0.075;
  const TypeErrors e{0.5 * kPi * (1.0 - 1.0 / 1.02),
                     4.0 * (actual.wheel_radius_right_m - actual.wheel_radius_left_m) / mean / actual.wheelbase_m};
  for (const bool cw : {true, false}) {
    const ReturnError predicted = square_return_error(e, 4.0, cw, actual.wheelbase_m);
    const ReturnError& driven = cw ? runs.clockwise[0] : runs.counter_clockwise[0];
    EXPECT_NEAR(predicted.x_m, driven.x_m, 1e-12);  // rounding only
    EXPECT_NEAR(predicted.y_m, driven.y_m, 1e-12);
    EXPECT_NEAR(predicted.heading_rad, driven.heading_rad, 1e-12);
  }
}

TEST(Umbmark, RecoversBothErrorsExactlyWhereFirstOrderDoesNot) {
  for (const TypeErrors e : {TypeErrors{0.05, 0.03}, TypeErrors{-0.04, 0.02}, TypeErrors{0.1, -0.12}}) {
    UmbmarkRuns runs;
    const double wheelbase = 0.34 * 0.5 * kPi / (0.5 * kPi - e.alpha_rad);
    runs.clockwise = {square_return_error(e, 4.0, true, wheelbase)};
    runs.counter_clockwise = {square_return_error(e, 4.0, false, wheelbase)};
    const auto c = calibrate_umbmark(runs, DifferentialDrive{});
    ASSERT_TRUE(c);
    EXPECT_NEAR(c->exact.alpha_rad, e.alpha_rad, 1e-9);
    EXPECT_NEAR(c->exact.beta_rad, e.beta_rad, 1e-9);
    EXPECT_NEAR(c->residual_m, 0.0, 1e-9);
    // The printed formulas err by the square of the errors: of the order of 1e-3 here, and far above rounding.
    EXPECT_GT(std::hypot(c->printed.alpha_rad - e.alpha_rad, c->printed.beta_rad - e.beta_rad), 1e-5);
    EXPECT_LT(std::hypot(c->printed.alpha_rad - e.alpha_rad, c->printed.beta_rad - e.beta_rad),
              10.0 * (e.alpha_rad * e.alpha_rad + e.beta_rad * e.beta_rad));
  }
}

TEST(Umbmark, OneCompensationSufficesEvenForLargeErrors) {
  const DifferentialDrive actual = machine(1.02, 0.94);
  const UmbmarkRuns before = square_runs(DifferentialDrive{}, actual);
  const auto c = calibrate_umbmark(before, DifferentialDrive{});
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->wheel_diameter_ratio, 1.02, 1e-9);
  EXPECT_NEAR(c->wheelbase_ratio, 0.94, 1e-9);
  EXPECT_NEAR(c->corrected.wheel_radius_left_m + c->corrected.wheel_radius_right_m, 0.15, 1e-15);  // Eq. 6.30
  EXPECT_NEAR(c->left_factor, 2.0 / (c->wheel_diameter_ratio + 1.0), 1e-15);                       // Eq. 6.33
  EXPECT_NEAR(c->right_factor, 2.0 / (1.0 / c->wheel_diameter_ratio + 1.0), 1e-15);                // Eq. 6.34
  const auto after = measure_umbmark(square_runs(c->corrected, actual));
  EXPECT_GT(measure_umbmark(before)->largest_systematic_error_m, 0.5);
  EXPECT_LT(after->largest_systematic_error_m, 1e-8);
}

TEST(Umbmark, CompensatesOnTopOfACompensation) {
  const DifferentialDrive actual = machine(1.012, 1.03), once = machine(1.005, 1.01);
  const auto c = calibrate_umbmark(square_runs(once, actual), once);
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->corrected.wheel_radius_right_m / c->corrected.wheel_radius_left_m, 1.012, 1e-6);
  // To keep the mean diameter of unequal wheels changes the mean way by the product of both corrections, 9e-6 here.
  EXPECT_NEAR(c->corrected.wheelbase_m, 0.34 * 1.03, 1e-5 * 0.35);
  EXPECT_NEAR(c->corrected.wheel_radius_left_m + c->corrected.wheel_radius_right_m, 0.15, 1e-15);
}

TEST(Umbmark, MeasuresClustersAsEquations3Point2To3Point4) {
  UmbmarkRuns runs;
  runs.clockwise = {{0.1, 0.2, 0.01}, {0.3, 0.4, 0.03}};
  runs.counter_clockwise = {{-0.1, 0.0, 0.0}, {-0.1, 0.1, 0.0}};
  const auto m = measure_umbmark(runs);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->clockwise.centre_of_gravity.x_m, 0.2, 1e-15);
  EXPECT_NEAR(m->clockwise.distance_m, std::hypot(0.2, 0.3), 1e-15);
  EXPECT_NEAR(m->clockwise.mean_heading_rad, 0.02, 1e-15);
  EXPECT_NEAR(m->clockwise.spread_m, std::sqrt(0.02 + 0.02), 1e-15);
  EXPECT_NEAR(m->largest_systematic_error_m, std::hypot(0.2, 0.3), 1e-15);
  EXPECT_NEAR(m->spread_m, std::sqrt((0.04 + 0.005) / 2.0), 1e-15);
  EXPECT_NEAR(m->standard_error_m, m->spread_m / std::sqrt(2.0), 1e-15);
  EXPECT_FALSE(measure_umbmark({4.0, {{0, 0, 0}}, {}}));
}

TEST(Umbmark, RaisesTheThreeSemRuleRarelyWithoutCauseAndAlwaysWithOne) {
  Random random(1);
  int without = 0, without_along_a_line = 0, with = 0;
  const int trials = 2000;
  for (int t = 0; t < trials; ++t) {
    const auto runs_about = [&](double x, bool along_a_line) {
      UmbmarkRuns runs;
      for (int i = 0; i < 5; ++i) {
        const double a = 0.018 * random.normal(), b = 0.018 * random.normal();
        runs.clockwise.push_back({x + a, along_a_line ? a : 0.018 * random.normal(), 0.0});
        runs.counter_clockwise.push_back({b, along_a_line ? -b : 0.018 * random.normal(), 0.0});
      }
      return runs;
    };
    without_along_a_line += measure_umbmark(runs_about(0.0, true))->worth_compensating;
    without += measure_umbmark(runs_about(0.0, false))->worth_compensating;
    with += measure_umbmark(runs_about(0.066, false))->worth_compensating;  // experiment 7: 66 mm, spread 25 mm
  }
  // Two clusters, F(2, 16) > 9: 0.5 % where x and y scatter alike; |t(8)| > 3: 3.4 % where they err together. Both
  // within the report's five per cent; of 2000 trials 3.4 % scatters by 0.4 %.
  EXPECT_LT(without, 0.011 * trials);
  EXPECT_NEAR(without_along_a_line, 0.034 * trials, 0.016 * trials);
  EXPECT_GT(with, 0.95 * trials);
}

TEST(Umbmark, StandardErrorsHoldInMonteCarlo) {
  const DifferentialDrive actual = machine(1.003, 1.01);
  const UmbmarkRuns exact = square_runs(DifferentialDrive{}, actual);
  Random random(2);
  double ratio_squares = 0.0, base_squares = 0.0;
  const int trials = 1000;
  for (int t = 0; t < trials; ++t) {
    UmbmarkRuns runs;
    for (int i = 0; i < 5; ++i) {  // x and y errors share a cause, mirrored in the other direction
      const double a = 0.02 * random.normal(), b = 0.02 * random.normal();
      runs.clockwise.push_back({exact.clockwise[0].x_m + a + 0.005 * random.normal(),
                                exact.clockwise[0].y_m + a + 0.005 * random.normal(), 0.0});
      runs.counter_clockwise.push_back({exact.counter_clockwise[0].x_m + b + 0.005 * random.normal(),
                                        exact.counter_clockwise[0].y_m - b + 0.005 * random.normal(), 0.0});
    }
    const auto c = calibrate_umbmark(runs, DifferentialDrive{});
    ratio_squares += std::pow((c->wheel_diameter_ratio - 1.003) / c->wheel_diameter_ratio_stderr, 2);
    base_squares += std::pow((c->wheelbase_ratio - 1.01) / c->wheelbase_ratio_stderr, 2);
  }
  // Student's t with 8 degrees of freedom has variance 8/6; its mean square over 1000 trials scatters by about 6 %.
  EXPECT_NEAR(ratio_squares / trials, 8.0 / 6.0, 0.25);
  EXPECT_NEAR(base_squares / trials, 8.0 / 6.0, 0.25);
}

TEST(Umbmark, FindsBothErrorsWhereOneDirectionHidesThem) {
  // Fig. 3.2: the turns err by as much as the sides, and cancel clockwise.
  const double beta = 0.02, alpha = -beta;
  const double wheelbase_ratio = 0.5 * kPi / (0.5 * kPi - alpha);
  const double half = 0.5 * 0.34 * wheelbase_ratio * beta / 4.0;
  const DifferentialDrive actual = machine((1 + half) / (1 - half), wheelbase_ratio);
  const UmbmarkRuns runs = square_runs(DifferentialDrive{}, actual);
  EXPECT_LT(measure_umbmark(runs)->clockwise.distance_m, 0.005);
  const auto one = calibrate_one_direction(runs, true, DifferentialDrive{});
  ASSERT_TRUE(one);
  EXPECT_NEAR(one->wheelbase_ratio, 1.0, 0.001);      // sees nothing to correct
  EXPECT_LT(one->predicted_error_this_way_m, 0.005);  // and promises success,
  EXPECT_GT(one->predicted_error_other_way_m, 0.4);   // while 2 L 2 alpha sqrt(2) = 0.45 m are left the other way
  const auto both = calibrate_umbmark(runs, DifferentialDrive{});
  EXPECT_NEAR(both->exact.alpha_rad, alpha, 1e-9);
  EXPECT_NEAR(both->exact.beta_rad, beta, 1e-9);
}

TEST(Umbmark, WhatOneDirectionPredictsOfTheOtherComesTrue) {
  const DifferentialDrive actual = machine(1.005, 1.0);
  const UmbmarkRuns runs = square_runs(DifferentialDrive{}, actual);
  const auto one = calibrate_one_direction(runs, false, DifferentialDrive{});
  ASSERT_TRUE(one);
  DifferentialDrive as_it_would_be;
  as_it_would_be.wheelbase_m *= one->wheelbase_ratio;
  const UmbmarkRuns then = square_runs(as_it_would_be, actual);
  const auto m = measure_umbmark(then);
  EXPECT_NEAR(m->clockwise.distance_m, one->predicted_error_other_way_m,
              1e-4);  // the centre's shift in a turn differs a little
  EXPECT_LT(m->counter_clockwise.distance_m, 0.1 * m->clockwise.distance_m);
}

TEST(ExtendedUmbmark, AveragesAbsoluteHeadingErrorsWithoutTheirBias) {
  UmbmarkRuns smooth, bumps;
  smooth.clockwise = {{0, 0, 0.02}, {0, 0, 0.04}};
  smooth.counter_clockwise = {{0, 0, -0.01}};
  bumps.clockwise = {{0, 0, 0.03 + 0.1}, {0, 0, 0.03 - 0.1}};  // of opposite sign: they must not cancel
  bumps.counter_clockwise = {{0, 0, -0.01 + 0.2}, {0, 0, -0.01 - 0.2}};
  const auto e = measure_extended_umbmark(smooth, bumps);
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->systematic_bias_clockwise_rad, 0.03, 1e-15);
  EXPECT_NEAR(e->systematic_bias_counter_clockwise_rad, -0.01, 1e-15);
  EXPECT_NEAR(e->mean_absolute_heading_error_rad, 0.15, 1e-15);
  EXPECT_FALSE(measure_extended_umbmark(smooth, {}));
}

}  // namespace
}  // namespace odolab
