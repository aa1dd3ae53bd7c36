#include "core/diagnosis/generic/unlike_recordings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/formatted.h"
#include "core/geometry/angles.h"

namespace odolab {

std::optional<UnlikeRecordings> unlike_recordings(const std::vector<double>& of_each) {
  const std::size_t n = of_each.size();
  if (n < 2) return std::nullopt;
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return of_each[a] < of_each[b]; });
  std::size_t low = 1;  // so many are below the widest gap
  for (std::size_t k = 2; k < n; ++k)
    if (of_each[order[k]] - of_each[order[k - 1]] > of_each[order[low]] - of_each[order[low - 1]]) low = k;
  const auto of_gap = order.begin() + static_cast<std::ptrdiff_t>(low);
  const auto mean = [&](auto from, auto to) {
    return std::accumulate(from, to, 0.0, [&](double sum, std::size_t r) { return sum + of_each[r]; }) /
           static_cast<double>(to - from);
  };
  const double apart = mean(of_gap, order.end()) - mean(order.begin(), of_gap);
  const bool first_is_low = std::find(order.begin(), of_gap, std::size_t{0}) != of_gap;
  const bool says_low = 2 * low < n || (2 * low == n && !first_is_low);
  UnlikeRecordings unlike;
  unlike.which.assign(says_low ? order.begin() : of_gap, says_low ? of_gap : order.end());
  std::sort(unlike.which.begin(), unlike.which.end());
  unlike.more = says_low ? -apart : apart;
  return unlike;
}

std::string in_words(const UnlikeRecordings& unlike, const std::vector<std::string>& names, bool per_metre) {
  constexpr std::size_t kMostSaid = 4;
  std::string words;
  const std::size_t said = std::min(unlike.which.size(), kMostSaid);
  for (std::size_t k = 0; k < said; ++k)
    words += (k == 0 ? "" : k + 1 == unlike.which.size() ? " and " : ", ") + names[unlike.which[k]];
  if (said < unlike.which.size()) words += formatted(" and %d more", static_cast<int>(unlike.which.size() - said));
  const double by = std::abs(unlike.more);
  words += per_metre ? formatted(", %.2g degrees per metre ", by * 180.0 / kPi) : formatted(", %.2g %% ", 100.0 * by);
  return words + (unlike.more > 0.0 ? "more than the others" : "less than the others");
}

}  // namespace odolab
