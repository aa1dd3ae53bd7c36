// Covariances of a pose, packed as xx, xy, xh, yy, yh, hh, and as matrices.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace odolab {

inline void add_symmetric(const Eigen::Matrix3d& m, double* packed) {
  packed[0] += m(0, 0);
  packed[1] += m(0, 1);
  packed[2] += m(0, 2);
  packed[3] += m(1, 1);
  packed[4] += m(1, 2);
  packed[5] += m(2, 2);
}

inline Eigen::Matrix3d symmetric(const double* packed) {
  Eigen::Matrix3d m;
  m << packed[0], packed[1], packed[2], packed[1], packed[3], packed[4], packed[2], packed[4], packed[5];
  return m;
}

// Of a motion by the heading that it starts with.
inline Eigen::Matrix3d rotation(double heading_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  Eigen::Matrix3d r;
  r << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return r;
}
}  // namespace odolab
