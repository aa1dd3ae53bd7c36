#include "core/diagnosis/units/laid_stretch.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

// An axle's way round half a circle, in a frame of its own.
std::vector<Pose> half_a_circle() {
  std::vector<Pose> way;
  for (int k = 0; k <= 10; ++k) {
    const double turned_rad = 0.1 * kPi * k;
    way.push_back({std::sin(turned_rad), 1.0 - std::cos(turned_rad), turned_rad});
  }
  return way;
}

TEST(LaidStretch, OfTheSameWayInAnotherFrameLeavesNothing) {
  const Pose joints_T_wheels{3.0, -2.0, 2.8};
  const std::vector<Pose> by_wheels = half_a_circle();
  std::vector<Pose> by_joints;
  for (const Pose& p : by_wheels) by_joints.push_back(joints_T_wheels * p);
  by_joints[4].heading_rad -= 2.0 * kPi;  // the same heading
  const LaidStretch laid = laid_stretch(by_joints, by_wheels);
  EXPECT_NEAR(laid.joints_T_wheels.x_m, 3.0, 1e-12);
  EXPECT_NEAR(laid.joints_T_wheels.y_m, -2.0, 1e-12);
  EXPECT_NEAR(laid.joints_T_wheels.heading_rad, 2.8, 1e-12);
  for (const Eigen::Vector3d& rest : laid.rest) EXPECT_LT(rest.norm(), 1e-12);
}

TEST(LaidStretch, SeesWhatOnePoseIsOffByInTheUnitsOwnFrameLessItsShareOfTheMean) {
  const std::vector<Pose> by_wheels = half_a_circle();
  std::vector<Pose> by_joints = by_wheels;
  by_joints[5] = by_joints[5] * Pose{0.011, 0.0, 0.0};  // ahead; of eleven poses
  const LaidStretch laid = laid_stretch(by_joints, by_wheels);
  EXPECT_NEAR(laid.rest[5][0], 0.010, 1e-12);
  EXPECT_NEAR(laid.rest[5][1], 0.0, 1e-12);
  EXPECT_NEAR(laid.rest[0][1], -0.001, 1e-12);  // it looks along what was ahead of the fifth less a quarter turn
  EXPECT_NEAR(laid.rest[5][2], 0.0, 1e-12);
}

}  // namespace
}  // namespace odolab
