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

}  // namespace odolab
