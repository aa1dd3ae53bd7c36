#include "core/calibration/smoothed_readings.h"

#include <algorithm>
#include <cmath>

#include "core/base/stamp_digits.h"
#include "core/calibration/parabola.h"

namespace odolab {

namespace {

constexpr double kHalfWindow_s = 0.25 + kStampDigits_s;  // what lies at its end is within it
constexpr int kFewestForACurve = 2;  // to either side; a parabola through three readings smooths nothing

}  // namespace

std::vector<WheelSample> smoothed(const std::vector<WheelSample>& readings) {
  std::vector<WheelSample> out = readings;
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
      p.add(readings[k].time_s - middle.time_s,
            {readings[k].left_rad - middle.left_rad, readings[k].right_rad - middle.right_rad});
    const BothWheels by = p.middle();
    if (!std::isfinite(by.left)) continue;  // stamps are all the same
    out[i].left_rad += by.left;
    out[i].right_rad += by.right;
  }
  return out;
}

}  // namespace odolab
