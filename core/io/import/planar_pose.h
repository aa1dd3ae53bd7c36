// Poses in space, as trackers and trajectories give them, laid onto the floor.
#pragma once

#include <array>

#include "core/geometry/pose.h"
#include "core/io/import/import_wishes.h"

namespace odolab {

struct SpacePose {
  std::array<double, 3> position{};
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row, body to room
};

// A rotation from a quaternion of any length but zero (x, y, z, w); NaN where it is zero.
std::array<double, 9> rotation_of(double qx, double qy, double qz, double qw);

struct PlanarPose {
  Pose floor_T_body;
  double uprightness =
      1.0;  // cosine of the tilt: near 1 for a vehicle on the floor, if the axes are what they are taken for
};

PlanarPose planar_pose(const SpacePose& pose, SpaceAxes axes);

}  // namespace odolab
