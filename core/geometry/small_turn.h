// Cosine and sine of an angle, sooner where it is small: what a vehicle turns between two readings.
#pragma once

#include <cmath>

namespace odolab {

struct Turn {
  double c = 1.0, s = 0.0;

  Turn then(const Turn& by) const { return {c * by.c - s * by.s, s * by.c + c * by.s}; }
};

// As exact as the library's; below 0.25 rad from series that end where nothing is left to a double.
inline Turn turn_of(double angle_rad) {
  if (!(std::abs(angle_rad) < 0.25)) return {std::cos(angle_rad), std::sin(angle_rad)};
  const double x = angle_rad, xx = x * x, x4 = xx * xx;
  const double c =
      (1.0 / 24.0 - xx * (1.0 / 720.0)) + x4 * ((1.0 / 40320.0 - xx * (1.0 / 3628800.0)) + x4 * (1.0 / 479001600.0));
  const double s = (1.0 / 120.0 - xx * (1.0 / 5040.0)) + x4 * (1.0 / 362880.0 - xx * (1.0 / 39916800.0));
  return {1.0 - xx * (0.5 - xx * c), x - x * xx * (1.0 / 6.0 - xx * s)};
}

// The chord of an arc that turns by so much, for each metre along it: sin(a/2) / (a/2).
inline double chord_share(double turn_rad) {
  const double x = 0.5 * turn_rad, xx = x * x;
  if (!(xx < 0.0625)) return std::sin(x) / x;
  return 1.0 - xx / 6.0 * (1.0 - xx / 20.0 * (1.0 - xx / 42.0 * (1.0 - xx / 72.0)));
}

// How fast the logarithm of that grows with the turn; of turns below a radian.
inline double chord_share_slope(double turn_rad) {
  const double xx = turn_rad * turn_rad;
  return -turn_rad / 12.0 * (1.0 + xx / 60.0 * (1.0 + xx / 42.0));
}

}  // namespace odolab
