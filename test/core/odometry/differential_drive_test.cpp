#include "core/odometry/differential_drive.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

TEST(DeadReckoning, GoesStraightByTheMeanOfBothWheels) {
  const Pose p = dead_reckoned(Pose{}, 2.0, 2.0, DifferentialDrive{});
  EXPECT_NEAR(p.x_m, 0.15, 1e-16);  // Eqs. 2.2, 2.3
  EXPECT_EQ(p.heading_rad, 0.0);
}

TEST(DeadReckoning, TurnsOnTheSpotByTheDifferenceOverTheWheelbase) {
  DifferentialDrive d;
  const double quarter = 0.25 * kPi * d.wheelbase_m / 0.075;
  const Pose p = dead_reckoned(Pose{}, -quarter, quarter, d);
  EXPECT_NEAR(p.heading_rad, kPi / 2, 1e-15);  // Eq. 2.4
  EXPECT_NEAR(length(p.position()), 0.0, 1e-16);
}

// A circle of radius v / w, run in n steps; both rules against the closed form.
double circle_error(int n, HeadingRule rule) {
  DifferentialDrive d;
  const double left = 8.0, right = 12.0;
  std::vector<WheelSample> wheels;
  for (int i = 0; i <= n; ++i) wheels.push_back({1.0 * i, left * i / n, right * i / n});
  const Pose end = dead_reckoned(wheels, d, Pose{}, rule).back().pose;
  const double turn = 0.075 * (right - left) / d.wheelbase_m, radius = 0.075 * 0.5 * (left + right) / turn;
  return length(end.position() - Vec2{radius * std::sin(turn), radius * (1 - std::cos(turn))});
}

TEST(DeadReckoning, AtTheMiddleHeadingIsOfSecondOrder) {
  EXPECT_NEAR(circle_error(20, HeadingRule::middle) / circle_error(40, HeadingRule::middle), 4.0, 0.05);
  EXPECT_LT(circle_error(100, HeadingRule::middle), 1e-5);
}

TEST(DeadReckoning, AsPrintedIsOfFirstOrder) {
  EXPECT_NEAR(circle_error(20, HeadingRule::end_as_printed) / circle_error(40, HeadingRule::end_as_printed), 2.0, 0.05);
  EXPECT_GT(circle_error(100, HeadingRule::end_as_printed), 1e-3);
}

TEST(DeadReckoning, HoldsEachCommandUntilTheNext) {
  const Track t = dead_reckoned(std::vector<CommandSample>{{0, 1.0, 0.0}, {2, 0.0, 0.5}, {3, 9.0, 9.0}}, Pose{});
  ASSERT_EQ(t.size(), 3u);
  EXPECT_NEAR(t[1].pose.x_m, 2.0, 1e-15);
  EXPECT_NEAR(t[2].pose.heading_rad, 0.5, 1e-15);  // the last command has no time to act
  EXPECT_NEAR(t[2].pose.x_m, 2.0, 1e-15);
}

TEST(DeadReckoning, OfAnArcIsExactInOneStep) {
  DifferentialDrive drive;
  // A quarter of a circle of radius R about the left: the wheels go (R -+ b/2) pi/2.
  const double radius_m = 0.8, quarter = 0.5 * kPi;
  const double left = (radius_m - 0.5 * drive.wheelbase_m) * quarter / drive.wheel_radius_left_m,
               right = (radius_m + 0.5 * drive.wheelbase_m) * quarter / drive.wheel_radius_right_m;
  const Pose end = dead_reckoned(Pose{}, left, right, drive, HeadingRule::arc);
  EXPECT_NEAR(end.x_m, radius_m, 1e-12);
  EXPECT_NEAR(end.y_m, radius_m, 1e-12);
  EXPECT_NEAR(end.heading_rad, quarter, 1e-12);
}

}  // namespace
}  // namespace odolab
