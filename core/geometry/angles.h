// Angles in radians, counter-clockwise positive.
#pragma once

#include <cmath>
#include <numbers>

namespace odolab {

constexpr double kPi = std::numbers::pi;

constexpr double degrees(double radians) { return radians * (180.0 / kPi); }
constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }

// The same direction in [-pi, pi].
inline double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * kPi); }

// The angle equal to `wrapped_rad` modulo a turn that lies nearest to `near_rad`.
inline double unwrapped(double wrapped_rad, double near_rad) { return near_rad + wrapped(wrapped_rad - near_rad); }

}  // namespace odolab
