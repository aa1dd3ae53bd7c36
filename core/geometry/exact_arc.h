// Motion at a constant velocity and turn rate, exactly.
#pragma once

#include "core/geometry/pose.h"

namespace odolab {

// `pose` moved by a constant velocity in its own frame, given as the products with the time: the exponential of SE(2).
inline Pose moved_exactly(const Pose& pose, double forward_m, double sideways_m, double turn_rad) {
  const double half = 0.5 * turn_rad;
  const double chord = std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;  // over the arc
  const Vec2 way = rotated({chord * forward_m, chord * sideways_m}, pose.heading_rad + half);
  return {pose.x_m + way.x_m, pose.y_m + way.y_m, pose.heading_rad + turn_rad};
}

}  // namespace odolab
