// A place and a heading in the plane: SE(2). Frames stand in the names: `floor_T_robot` maps the robot's frame to the
// floor's.
#pragma once

#include <cmath>

#include "core/geometry/angles.h"

namespace odolab {

struct Vec2 {
  double x_m = 0.0;
  double y_m = 0.0;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x_m + b.x_m, a.y_m + b.y_m}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x_m - b.x_m, a.y_m - b.y_m}; }
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x_m, s * a.y_m}; }
inline double dot(Vec2 a, Vec2 b) { return a.x_m * b.x_m + a.y_m * b.y_m; }
inline double cross(Vec2 a, Vec2 b) { return a.x_m * b.y_m - a.y_m * b.x_m; }
inline double length(Vec2 a) { return std::hypot(a.x_m, a.y_m); }
inline Vec2 rotated(Vec2 a, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * a.x_m - s * a.y_m, s * a.x_m + c * a.y_m};
}

// x forward, y left, heading counter-clockwise; the heading is not wrapped.
struct Pose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  Vec2 position() const { return {x_m, y_m}; }
};

// a_T_c = a_T_b * b_T_c
inline Pose operator*(const Pose& a, const Pose& b) {
  const Vec2 p = rotated(b.position(), a.heading_rad);
  return {a.x_m + p.x_m, a.y_m + p.y_m, a.heading_rad + b.heading_rad};
}

// The place on the floor of a point given in the pose's frame.
inline Vec2 operator*(const Pose& a, Vec2 point) { return a.position() + rotated(point, a.heading_rad); }

inline Pose inverse(const Pose& a) {
  const Vec2 p = rotated(a.position(), -a.heading_rad);
  return {-p.x_m, -p.y_m, -a.heading_rad};
}

// The pose of `to` as seen from `from`: inverse(from) * to.
inline Pose between(const Pose& from, const Pose& to) {
  const Vec2 p = rotated(to.position() - from.position(), -from.heading_rad);
  return {p.x_m, p.y_m, to.heading_rad - from.heading_rad};
}

// `pose` moved by `distance_m` along an arc that turns by `turn_rad`, the chord taken at the middle heading.
inline Pose advanced(const Pose& pose, double distance_m, double turn_rad) {
  const double middle = pose.heading_rad + 0.5 * turn_rad;
  return {pose.x_m + distance_m * std::cos(middle), pose.y_m + distance_m * std::sin(middle),
          pose.heading_rad + turn_rad};
}

}  // namespace odolab
