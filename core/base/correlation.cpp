#include "core/base/correlation.h"

#include <cstddef>

namespace odolab {

namespace {
double products(const std::vector<std::vector<double>>& stretches, std::size_t apart) {
  double sum = 0.0;
  for (const std::vector<double>& values : stretches)
    for (std::size_t i = apart; i < values.size(); ++i) sum += values[i] * values[i - apart];
  return sum;
}
}  // namespace

double sum_widened_by_correlation(const std::vector<std::vector<double>>& stretches) {
  constexpr std::size_t kMostApart = 200;
  const double squares = products(stretches, 0);
  if (squares <= 0.0) return 1.0;
  double widened = 1.0;
  for (std::size_t apart = 1; apart < kMostApart; apart += 2) {
    const double pair = (products(stretches, apart) + products(stretches, apart + 1)) / squares;
    if (pair <= 0.0) break;
    widened += 2.0 * pair;
  }
  return widened;
}

}  // namespace odolab
