#include "core/diagnosis/encoder_jumps.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace odolab {

namespace {

// By how much a rate stands out from those before and behind it, on the same side of both: a wheel that stops or sets
// off is like one of them.
double standing_out(const std::vector<double>& rates, std::size_t i) {
  constexpr std::size_t kAround = 3;
  if (i < kAround || i + kAround >= rates.size()) return 0.0;
  const auto at = rates.begin() + static_cast<std::ptrdiff_t>(i);
  const double before = median({at - kAround, at}), behind = median({at + 1, at + 1 + kAround});
  const double up = rates[i] - std::max(before, behind), down = std::min(before, behind) - rates[i];
  return std::max({0.0, up, down});
}

}  // namespace

TimeStretches encoder_jumps(const std::vector<double>& time_s, const std::vector<double>& angle_rad, double radius_m,
                            double count_rad) {
  constexpr double kGap_s = 0.5;  // a step over more is no step
  constexpr double kLeast_m = 0.02;
  constexpr double kTyre_mps2 = 20.0;  // twice what a tyre can push
  std::vector<double> rates, speeds;
  for (std::size_t i = 0; i + 1 < angle_rad.size(); ++i)
    rates.push_back((angle_rad[i + 1] - angle_rad[i]) / (time_s[i + 1] - time_s[i]));
  if (rates.empty()) return {};
  for (double r : rates) speeds.push_back(std::abs(r));
  const double usual = quantile(speeds, 0.97);
  std::vector<double> out_by(rates.size());
  for (std::size_t i = 0; i < rates.size(); ++i) out_by[i] = standing_out(rates, i);
  const double trembles = quantile(out_by, 0.97);
  TimeStretches jumps;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double gap = time_s[i + 1] - time_s[i], by = rates[i] * gap;
    if (gap >= kGap_s) continue;
    const bool back_and_on =
        i > 0 && i + 1 < rates.size() && rates[i] * rates[i - 1] < 0.0 && rates[i] * rates[i + 1] < 0.0;
    const bool too_fast = std::abs(by) * radius_m > kLeast_m && std::abs(by) > 1.5 * count_rad &&
                          speeds[i] > (back_and_on ? 1.0 : 4.0) * usual;
    // One reading off the pace that the wheel had before and has behind it, where no tyre could have pushed it.
    const bool off_its_pace = out_by[i] * gap > 4.0 * count_rad && out_by[i] > 4.0 * trembles &&
                              out_by[i] > 0.5 * usual && out_by[i] * radius_m > kTyre_mps2 * gap;
    if (too_fast || off_its_pace) jumps.push_back({time_s[i], time_s[i + 1]});
  }
  return jumps;
}

}  // namespace odolab
