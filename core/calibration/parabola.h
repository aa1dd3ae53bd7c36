// A parabola through readings, by least squares.
#pragma once

namespace odolab {

// Of both wheels, read at the same times.
struct BothWheels {
  double left = 0.0, right = 0.0;
};
inline BothWheels operator+(const BothWheels& a, const BothWheels& b) { return {a.left + b.left, a.right + b.right}; }
inline BothWheels operator-(const BothWheels& a, const BothWheels& b) { return {a.left - b.left, a.right - b.right}; }
inline BothWheels operator*(double by, const BothWheels& a) { return {by * a.left, by * a.right}; }

// The sums of what is laid through readings at times `s` from a middle one. Not finite where times are all the same.
struct Parabola {
  double n = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0, s4 = 0.0;
  BothWheels y, sy, ssy;
  void add(double s, const BothWheels& value, double weight = 1.0) {
    const double ws = weight * s, wss = ws * s;
    n += weight, s1 += ws, s2 += wss, s3 += wss * s, s4 += wss * (s * s);
    y = y + weight * value, sy = sy + ws * value, ssy = ssy + wss * value;
  }
  BothWheels middle() const {
    const double a = s2 * s4 - s3 * s3, b = s1 * s4 - s2 * s3, c = s1 * s3 - s2 * s2;
    return 1.0 / (n * a - s1 * b + s2 * c) * (a * y - b * sy + c * ssy);
  }
  BothWheels second_derivative() const {
    const double a = s1 * s3 - s2 * s2, b = n * s3 - s1 * s2, c = n * s2 - s1 * s1;
    return 2.0 / (s2 * a - s3 * b + s4 * c) * (a * y - b * sy + c * ssy);
  }
};

}  // namespace odolab
