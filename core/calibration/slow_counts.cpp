#include "core/calibration/slow_counts.h"

#include <cmath>

#include "core/calibration/rests.h"

namespace odolab {

namespace {

void draw(const std::vector<WheelSample>& readings, double WheelSample::*wheel, double count_rad,
          std::vector<WheelSample>& out) {
  const int n = static_cast<int>(readings.size());
  const auto counts_after = [&](int i) { return (readings[i + 1].*wheel - readings[i].*wheel) / count_rad; };
  const auto edge_s = [&](int i) { return 0.5 * (readings[i].time_s + readings[i + 1].time_s); };
  const auto edge_rad = [&](int i) { return 0.5 * (readings[i].*wheel + readings[i + 1].*wheel); };
  int before = -1;  // the last interval that brought a count
  for (int i = 0; i + 1 < n; ++i) {
    const double counts = counts_after(i);
    if (counts == 0.0) continue;
    const bool slow = before >= 0 && i - before > 1 && std::abs(counts) < 1.5 && std::abs(counts_after(before)) < 1.5 &&
                      counts * counts_after(before) > 0.0 && edge_s(i) - edge_s(before) < kRest_s;
    if (slow) {
      const double from_s = edge_s(before), slope = (edge_rad(i) - edge_rad(before)) / (edge_s(i) - from_s);
      for (int k = before + 1; k <= i; ++k) out[k].*wheel = edge_rad(before) + slope * (readings[k].time_s - from_s);
    }
    before = i;
  }
}

}  // namespace

std::vector<WheelSample> with_slow_counts_drawn(const std::vector<WheelSample>& readings, double count_rad) {
  std::vector<WheelSample> out = readings;
  draw(readings, &WheelSample::left_rad, count_rad, out);
  draw(readings, &WheelSample::right_rad, count_rad, out);
  return out;
}

}  // namespace odolab
