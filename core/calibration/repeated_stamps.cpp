#include "core/calibration/repeated_stamps.h"

#include "core/base/quantile.h"

namespace odolab {

std::optional<SpreadStamps> spread_repeated(const std::vector<double>& time_s) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < time_s.size(); ++i)
    if (time_s[i] > time_s[i - 1]) gaps.push_back(time_s[i] - time_s[i - 1]);
  if (gaps.empty() || gaps.size() + 1 == time_s.size()) return std::nullopt;
  const double usual_s = median(std::move(gaps));
  SpreadStamps spread{time_s, 0};
  for (std::size_t first = 0, end = 0; first < time_s.size(); first = end) {
    while (end < time_s.size() && time_s[end] == time_s[first]) ++end;
    const std::size_t readings = end - first;
    if (readings < 2) continue;
    const auto holds_all = [&](double gap_s) { return gap_s > (static_cast<double>(readings) - 0.5) * usual_s; };
    const double behind_s = end < time_s.size() ? time_s[end] - time_s[first] : 0.0;
    const double before_s = first > 0 ? time_s[first] - time_s[first - 1] : 0.0;
    const bool goes_on = holds_all(behind_s);
    if (!goes_on && !holds_all(before_s)) continue;
    const double step_s = (goes_on ? behind_s : before_s) / static_cast<double>(readings);
    for (std::size_t k = 0; k < readings; ++k)
      spread.time_s[first + k] +=
          step_s * (static_cast<double>(k) - (goes_on ? 0.0 : static_cast<double>(readings - 1)));
    spread.repeated += static_cast<int>(readings) - 1;
  }
  if (spread.repeated == 0) return std::nullopt;
  return spread;
}

}  // namespace odolab
