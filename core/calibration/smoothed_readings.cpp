#include "core/calibration/smoothed_readings.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr double kHalfWindow_s = 0.25;
constexpr int kFewestForACurve = 2;  // to either side; a parabola through three readings smooths nothing

// The middle of a parabola through readings at times `s` from the middle one, by least squares.
struct Parabola {
  double n = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0, s4 = 0.0, y = 0.0, sy = 0.0, ssy = 0.0;
  void add(double s, double value) {
    const double ss = s * s;
    n += 1.0, s1 += s, s2 += ss, s3 += ss * s, s4 += ss * ss;
    y += value, sy += s * value, ssy += ss * value;
  }
  double middle() const {
    const double a = s2 * s4 - s3 * s3, b = s1 * s4 - s2 * s3, c = s1 * s3 - s2 * s2;
    return (y * a - sy * b + ssy * c) / (n * a - s1 * b + s2 * c);
  }
};

void smooth(const std::vector<WheelSample>& readings, double WheelSample::*wheel, std::vector<WheelSample>& out) {
  const int n = static_cast<int>(readings.size());
  int half = 0;
  for (int i = 0; i < n; ++i) {
    const WheelSample& middle = readings[i];
    const auto allowed = [&](int h) {
      return i - h >= 0 && i + h < n && middle.time_s - readings[i - h].time_s <= kHalfWindow_s &&
             readings[i + h].time_s - middle.time_s <= kHalfWindow_s;
    };
    while (half > 0 && !allowed(half)) --half;
    while (allowed(half + 1)) ++half;
    if (half < kFewestForACurve) continue;
    Parabola p;
    for (int k = i - half; k <= i + half; ++k)
      p.add(readings[k].time_s - middle.time_s, readings[k].*wheel - middle.*wheel);
    const double by = p.middle();
    if (std::isfinite(by)) out[i].*wheel += by;  // stamps may all be the same
  }
}

}  // namespace

std::vector<WheelSample> smoothed(const std::vector<WheelSample>& readings) {
  std::vector<WheelSample> out = readings;
  if (readings.empty()) return out;
  smooth(readings, &WheelSample::left_rad, out);
  smooth(readings, &WheelSample::right_rad, out);
  return out;
}

}  // namespace odolab
