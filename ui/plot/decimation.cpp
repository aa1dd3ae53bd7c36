#include "ui/plot/decimation.h"

#include <algorithm>

namespace odolab::ui {

std::vector<std::size_t> decimated(const double* x, const double* y, std::size_t count, double x0, double x1,
                                   int columns) {
  std::vector<std::size_t> kept;
  if (count == 0 || !(x1 > x0) || columns < 1) return kept;
  std::size_t begin = std::size_t(std::lower_bound(x, x + count, x0) - x);
  std::size_t end = std::size_t(std::upper_bound(x, x + count, x1) - x);
  if (begin > 0) --begin;
  if (end < count) ++end;
  if (end - begin <= std::size_t(4 * columns)) {
    for (std::size_t i = begin; i < end; ++i) kept.push_back(i);
    return kept;
  }
  const double columns_per_unit = columns / (x1 - x0);
  const auto column_of = [&](std::size_t i) { return (x[i] - x0) * columns_per_unit; };
  std::size_t i = begin;
  while (i < end) {
    const long column = long(std::max(-1.0, std::min(double(columns), column_of(i))));
    std::size_t first = i, least = i, greatest = i, last = i;
    for (; i < end && long(std::max(-1.0, std::min(double(columns), column_of(i)))) == column; ++i) {
      if (y[i] < y[least]) least = i;
      if (y[i] > y[greatest]) greatest = i;
      last = i;
    }
    std::size_t four[] = {first, std::min(least, greatest), std::max(least, greatest), last};
    for (const std::size_t k : four)
      if (kept.empty() || kept.back() < k) kept.push_back(k);
  }
  return kept;
}

}  // namespace odolab::ui
