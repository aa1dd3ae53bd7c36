// A parabola through readings, by least squares.
#pragma once

namespace odolab {

// The sums of what is laid through readings at times `s` from a middle one. Not finite where times are all the same.
struct Parabola {
  double n = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0, s4 = 0.0, y = 0.0, sy = 0.0, ssy = 0.0;
  void add(double s, double value, double weight = 1.0) {
    const double ws = weight * s, wss = ws * s;
    n += weight, s1 += ws, s2 += wss, s3 += wss * s, s4 += wss * (s * s);
    y += weight * value, sy += ws * value, ssy += wss * value;
  }
  double middle() const {
    const double a = s2 * s4 - s3 * s3, b = s1 * s4 - s2 * s3, c = s1 * s3 - s2 * s2;
    return (y * a - sy * b + ssy * c) / (n * a - s1 * b + s2 * c);
  }
  double second_derivative() const {
    const double a = s1 * s3 - s2 * s2, b = n * s3 - s1 * s2, c = n * s2 - s1 * s1;
    return 2.0 * (y * a - sy * b + ssy * c) / (s2 * a - s3 * b + s4 * c);
  }
};

}  // namespace odolab
