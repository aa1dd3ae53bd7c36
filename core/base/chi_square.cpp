#include "core/base/chi_square.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace odolab {

namespace {

// I_z(a, b), the regularised incomplete beta function, by its power series, all of whose terms are positive.
double beta_share(double a, double b, double z) {
  double term = 1.0, sum = 1.0;
  for (int n = 1; n < 10000 && term > 1e-15 * sum; ++n) {
    term *= z * (a + b + n - 1.0) / (a + n);
    sum += term;
  }
  const double log_front =
      a * std::log(z) + b * std::log1p(-z) - std::log(a) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b);
  return std::exp(log_front) * sum;
}

}  // namespace

double chi_square_tail(double x, int freedom) {
  if (x <= 0.0) return 1.0;
  // Regularised incomplete gamma by recurrence from freedom 1 or 2.
  double tail = freedom % 2 == 0 ? std::exp(-0.5 * x) : std::erfc(std::sqrt(0.5 * x));
  double term = freedom % 2 == 0 ? std::exp(-0.5 * x) : std::sqrt(2.0 * x / kPi) * std::exp(-0.5 * x);
  for (int k = freedom % 2 == 0 ? 2 : 1; k < freedom; k += 2) {
    if (freedom % 2 == 0) term *= 0.5 * x / (0.5 * k);
    tail += term;
    if (freedom % 2 == 1) term *= x / (k + 2);
  }
  return std::min(1.0, tail);
}

double scaled_chi_square_tail(double x, int freedom, double batches) {
  if (x <= 0.0) return 1.0;
  if (batches > 1e4) return chi_square_tail(x, freedom);
  const double a = 0.5 * batches, b = 0.5 * freedom, z = batches / (batches + x);
  // Near 1 its series takes thousands of terms, and that of the rest few.
  if (z > (a + 1.0) / (a + b + 2.0)) return std::max(0.0, 1.0 - beta_share(b, a, x / (batches + x)));
  return std::min(1.0, beta_share(a, b, z));
}

}  // namespace odolab
