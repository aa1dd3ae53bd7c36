#include "core/diagnosis/quality/no_fix.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"

namespace odolab {

std::vector<char> rows_without_fix(const Recording& recording) {
  constexpr double kNear_m = 0.2;
  std::vector<char> without(recording.time_s.size(), 0);
  const Channel *x = recording.channel("truth_x_m"), *y = recording.channel("truth_y_m"),
                *heading = recording.channel("truth_heading_rad");
  if (!x || !y) return without;
  const auto is_zero = [&](std::size_t row) {
    return x->values[row] == 0.0 && y->values[row] == 0.0 && !(heading && std::abs(heading->values[row]) > 0.0);
  };
  const auto is_near = [&](std::size_t row) { return std::hypot(x->values[row], y->values[row]) < kNear_m; };
  std::vector<std::size_t> rows;  // with truth
  for (std::size_t i = 0; i < recording.time_s.size(); ++i)
    if (std::isfinite(x->values[i]) && std::isfinite(y->values[i])) rows.push_back(i);
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first;
    while (end < rows.size() && is_zero(rows[end])) ++end;
    const bool begins_near = first > 0 && is_near(rows[first - 1]), ends_near = end < rows.size() && is_near(rows[end]);
    const bool is_all = end - first == rows.size();
    for (std::size_t k = first; k < end; ++k) without[rows[k]] = !begins_near && !ends_near && !is_all;
    first = end + 1;
  }
  return without;
}

std::optional<std::string> said_of_rows_without_fix(const Recording& recording, const std::vector<char>& rows) {
  const auto count = std::count(rows.begin(), rows.end(), 1);
  if (count == 0) return std::nullopt;
  const auto first = static_cast<std::size_t>(std::find(rows.begin(), rows.end(), 1) - rows.begin());
  return recording.name + formatted(
                              ": the truth is exactly 0, 0 in %ld rows, first at %.2f s, and nowhere near before "
                              "and after, as where a tracker sees nothing: left out",
                              static_cast<long>(count), recording.time_s[first]);
}

}  // namespace odolab
