#include "core/base/quantile.h"

#include <algorithm>
#include <cmath>

namespace odolab {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  return values.size() % 2 == 1 ? *upper : 0.5 * (*upper + *std::max_element(values.begin(), upper));
}

double scatter_about_zero(std::vector<double> values) {
  constexpr double kOfMedianSize = 1.4826;  // 1 / (the third quartile of a standard normal number)
  for (double& v : values) v = std::abs(v);
  return kOfMedianSize * median(std::move(values));
}

}  // namespace odolab
