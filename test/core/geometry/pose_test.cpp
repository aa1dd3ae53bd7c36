#include "core/geometry/pose.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

void expect_same_pose(const Pose& a, const Pose& b) {
  EXPECT_NEAR(a.x_m, b.x_m, 1e-14);  // rounding of numbers of order one
  EXPECT_NEAR(a.y_m, b.y_m, 1e-14);
  EXPECT_NEAR(a.heading_rad, b.heading_rad, 1e-14);
}

TEST(Angles, WrapIntoHalfATurnEitherSide) {
  EXPECT_NEAR(wrapped(3 * kPi / 2), -kPi / 2, 1e-15);
  EXPECT_NEAR(wrapped(-7.0), -7.0 + 2 * kPi, 1e-15);
  EXPECT_NEAR(unwrapped(-3.1, 3.1), 2 * kPi - 3.1, 1e-14);
  EXPECT_NEAR(degrees(radians(37.0)), 37.0, 1e-13);
}

TEST(Pose, ComposesAsAGroup) {
  const Pose a{1.0, 2.0, 0.7}, b{-0.5, 0.3, -2.0}, c{0.2, 0.9, 4.0};
  expect_same_pose((a * b) * c, a * (b * c));
  expect_same_pose(a * inverse(a), Pose{});
  expect_same_pose(inverse(a) * b, between(a, b));
  expect_same_pose(a * between(a, b), b);
}

TEST(Pose, MapsAPointFromItsFrameToTheFloor) {
  const Vec2 p = Pose{1.0, 2.0, kPi / 2} * Vec2{3.0, 1.0};
  EXPECT_NEAR(p.x_m, 0.0, 1e-15);
  EXPECT_NEAR(p.y_m, 5.0, 1e-15);
}

TEST(Pose, AdvancesAlongTheChordAtTheMiddleHeading) {
  const Pose p = advanced({0, 0, 0.1}, 2.0, 0.4);
  EXPECT_NEAR(std::atan2(p.y_m, p.x_m), 0.3, 1e-15);
  EXPECT_NEAR(length(p.position()), 2.0, 1e-15);
  EXPECT_NEAR(p.heading_rad, 0.5, 1e-15);
}

TEST(Vec2, DotAndCrossMeasureTheAngle) {
  const Vec2 a{2.0, 0.0}, b = rotated(a, 0.3);
  EXPECT_NEAR(std::atan2(cross(a, b), dot(a, b)), 0.3, 1e-15);
}

}  // namespace
}  // namespace odolab
