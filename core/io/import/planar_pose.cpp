#include "core/io/import/planar_pose.h"

#include <cmath>
#include <limits>

namespace odolab {

namespace {

// For each floor axis (x, y, up) which axis of space it is, and its sign.
struct AxisMap {
  int from[3];
  double sign[3];
};

AxisMap map_of(SpaceAxes axes) {
  switch (axes) {
    case SpaceAxes::y_up:
      return {{0, 2, 1}, {1.0, -1.0, 1.0}};
    case SpaceAxes::camera:
      return {{2, 0, 1}, {1.0, -1.0, -1.0}};
    case SpaceAxes::z_up:
      break;
  }
  return {{0, 1, 2}, {1.0, 1.0, 1.0}};
}

}  // namespace

std::array<double, 9> rotation_of(double qx, double qy, double qz, double qw) {
  const double norm = qx * qx + qy * qy + qz * qz + qw * qw;
  std::array<double, 9> r;
  if (!(norm > 1e-12)) {
    r.fill(std::numeric_limits<double>::quiet_NaN());
    return r;
  }
  const double s = 2.0 / norm;
  return {1.0 - s * (qy * qy + qz * qz), s * (qx * qy - qz * qw),       s * (qx * qz + qy * qw),
          s * (qx * qy + qz * qw),       1.0 - s * (qx * qx + qz * qz), s * (qy * qz - qx * qw),
          s * (qx * qz - qy * qw),       s * (qy * qz + qx * qw),       1.0 - s * (qx * qx + qy * qy)};
}

PlanarPose planar_pose(const SpacePose& pose, SpaceAxes axes) {
  const AxisMap map = map_of(axes);
  const auto at = [&](int row, int column) {
    return map.sign[row] * map.sign[column] *
           pose.rotation[static_cast<std::size_t>(3 * map.from[row] + map.from[column])];
  };
  const auto position = [&](int row) { return map.sign[row] * pose.position[static_cast<std::size_t>(map.from[row])]; };
  return {{position(0), position(1), std::atan2(at(1, 0), at(0, 0))}, at(2, 2)};
}

}  // namespace odolab
