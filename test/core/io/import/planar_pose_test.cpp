#include "core/io/import/planar_pose.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

// The same drive seen in three kinds of axes: at 2 m ahead, 1 m to the left, turned left by 0.3 rad.
TEST(PlanarPose, IsTheSameInWhateverAxesItWasSeen) {
  const double s = std::sin(0.15), c = std::cos(0.15);
  const SpacePose z_up{{2.0, 1.0, 0.5}, rotation_of(0, 0, s, c)};
  const SpacePose y_up{{2.0, 0.5, -1.0}, rotation_of(0, s, 0, c)};      // Motive: x, up, to the right
  const SpacePose camera{{-1.0, -0.5, 2.0}, rotation_of(0, -s, 0, c)};  // KITTI: right, down, ahead
  for (const auto& [pose, axes] :
       {std::pair{z_up, SpaceAxes::z_up}, std::pair{y_up, SpaceAxes::y_up}, std::pair{camera, SpaceAxes::camera}}) {
    const PlanarPose planar = planar_pose(pose, axes);
    EXPECT_EQ(planar.floor_T_body.x_m, 2.0);
    EXPECT_EQ(planar.floor_T_body.y_m, 1.0);
    EXPECT_NEAR(planar.floor_T_body.heading_rad, 0.3, 1e-15);
    EXPECT_NEAR(planar.uprightness, 1.0, 1e-15);
  }
  EXPECT_LT(planar_pose(camera, SpaceAxes::z_up).uprightness, 1.0);
}

TEST(PlanarPose, TakesAQuaternionOfAnyLengthButZero) {
  EXPECT_NEAR(planar_pose({{}, rotation_of(0, 0, 3.0, 3.0)}, SpaceAxes::z_up).floor_T_body.heading_rad, std::acos(0.0),
              1e-15);
  EXPECT_TRUE(std::isnan(planar_pose({{}, rotation_of(0, 0, 0, 0)}, SpaceAxes::z_up).floor_T_body.heading_rad));
}

}  // namespace
}  // namespace odolab
