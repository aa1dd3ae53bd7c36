#include "core/calibration/slow_counts.h"

#include <cmath>

#include "core/calibration/rests.h"

namespace odolab {

namespace {

void draw_between_counts(const std::vector<WheelSample>& readings, double WheelSample::*wheel, double count_rad,
                         std::vector<WheelSample>& out) {
  const std::vector<Movement> all = movements(readings, wheel);
  const auto edge_s = [&](int i) { return 0.5 * (readings[i].time_s + readings[i + 1].time_s); };
  const auto edge_rad = [&](int i) { return 0.5 * (readings[i].*wheel + readings[i + 1].*wheel); };
  const auto is_a_count = [&](const Movement& m) { return std::abs(m.by) < 1.5 * count_rad; };
  for (std::size_t m = 0; m + 1 < all.size(); ++m) {
    const int before = all[m].interval, i = all[m + 1].interval;
    const bool slow = i - before > 1 && is_a_count(all[m]) && is_a_count(all[m + 1]) &&
                      all[m].by * all[m + 1].by > 0.0 && !all[m].then_rests;
    if (!slow) continue;
    const double from_s = edge_s(before), slope = (edge_rad(i) - edge_rad(before)) / (edge_s(i) - from_s);
    for (int k = before + 1; k <= i; ++k) out[k].*wheel = edge_rad(before) + slope * (readings[k].time_s - from_s);
  }
}

}  // namespace

std::vector<WheelSample> with_slow_counts_drawn(const std::vector<WheelSample>& readings, double count_rad) {
  std::vector<WheelSample> out = readings;
  draw_between_counts(readings, &WheelSample::left_rad, count_rad, out);
  draw_between_counts(readings, &WheelSample::right_rad, count_rad, out);
  return out;
}

}  // namespace odolab
