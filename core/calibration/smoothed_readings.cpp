#include "core/calibration/smoothed_readings.h"

namespace odolab {

namespace {

constexpr double kHalfWindow_s = 0.25;

void smooth(const std::vector<WheelSample>& readings, double WheelSample::*wheel, std::vector<WheelSample>& out) {
  const int n = static_cast<int>(readings.size());
  const double rad_0 = readings[0].*wheel, time_0_s = readings[0].time_s;
  std::vector<double> sum_rad(n + 1, 0.0), sum_s(n + 1, 0.0);
  for (int i = 0; i < n; ++i) {
    sum_rad[i + 1] = sum_rad[i] + (readings[i].*wheel - rad_0);
    sum_s[i + 1] = sum_s[i] + (readings[i].time_s - time_0_s);
  }
  int half = 0;
  for (int i = 0; i < n; ++i) {
    const auto allowed = [&](int h) {
      return i - h >= 0 && i + h < n && readings[i].time_s - readings[i - h].time_s <= kHalfWindow_s &&
             readings[i + h].time_s - readings[i].time_s <= kHalfWindow_s;
    };
    while (half > 0 && !allowed(half)) --half;
    while (allowed(half + 1)) ++half;
    if (half == 0) continue;
    const int from = i - half, to = i + half + 1;
    const double mean_rad = (sum_rad[to] - sum_rad[from]) / (to - from);
    const double mean_s = (sum_s[to] - sum_s[from]) / (to - from);
    const double slope =
        (readings[to - 1].*wheel - readings[from].*wheel) / (readings[to - 1].time_s - readings[from].time_s);
    out[i].*wheel = rad_0 + mean_rad + slope * (readings[i].time_s - time_0_s - mean_s);
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
