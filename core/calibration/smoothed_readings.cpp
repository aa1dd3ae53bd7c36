#include "core/calibration/smoothed_readings.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/parabola.h"

namespace odolab {

namespace {

constexpr double kHalfWindow_s = 0.25;
constexpr int kFewestForACurve = 2;  // to either side; a parabola through three readings smooths nothing

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
