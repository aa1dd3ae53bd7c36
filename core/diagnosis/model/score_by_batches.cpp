#include "core/diagnosis/model/score_by_batches.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace odolab {

namespace {

constexpr double kFewestToScatter = 1.5;  // batches that matter: one is its own fit
constexpr double kFewestToTell = 3.0;     // batches that matter

// The 95 % quantile of chi-square over its freedom (E. B. Wilson and M. M. Hilferty, Proc. National Academy of Sciences
// 17(12):684-688, 1931).
double largest_by_chance(double freedom) {
  constexpr double kStandard = 1.645;
  const double spread = 2.0 / (9.0 * freedom);
  return std::pow(1.0 - spread + kStandard * std::sqrt(spread), 3);
}

}  // namespace

void ScoreByBatches::finish() {
  double sum_u = 0.0, sum_i = 0.0, square = 0.0;
  for (std::size_t n = 0; n < u.size(); ++n) sum_u += u[n], sum_i += i[n], square += i[n] * i[n];
  if (sum_i <= 0.0) {
    u.clear(), i.clear();
    return;
  }
  count = sum_i * sum_i / std::max(square, 1e-300);
  double about_fit = 0.0;
  for (std::size_t n = 0; n < u.size(); ++n) about_fit += std::pow(u[n] - sum_u / sum_i * i[n], 2);
  scatter = unbiased_scatter(about_fit / sum_i, count);
}

double ScoreByBatches::inflation(double batches_believed_white) const {
  return shrunk_inflation(scatter, count, batches_believed_white);
}

double ScoreByBatches::cross_validated() const {
  double gain = 0.0;
  for (int half = 0; half < 2; ++half) {
    double fu = 0.0, fi = 0.0, tu = 0.0, ti = 0.0;
    for (std::size_t n = 0; n < u.size(); ++n)
      (static_cast<int>(n % 2) == half ? fu : tu) += u[n], (static_cast<int>(n % 2) == half ? fi : ti) += i[n];
    if (fi <= 0.0) continue;
    const double fitted = fu / fi;
    gain += 2.0 * fitted * tu - fitted * fitted * ti;
  }
  return gain;
}

double unbiased_scatter(double about_fit, double count) {
  return count > kFewestToScatter ? about_fit * count / (count - 1.0) : 1.0;
}

double shrunk_inflation(double scatter, double count, double batches_believed_white) {
  const double shrunk = (batches_believed_white + count * scatter) / (batches_believed_white + count);
  const double by_itself = count > kFewestToScatter ? scatter / largest_by_chance(count - 1.0) : 1.0;
  return std::max({1.0, shrunk, by_itself});
}

double scatter_of_statistics(const std::vector<double>& statistics, int freedom) {
  constexpr double kMedian[4] = {0.0, 0.455, 1.386, 2.366}, kNinety[4] = {0.0, 2.706, 4.605, 6.251};
  const int k = std::min(3, freedom);
  return std::max(quantile(statistics, 0.5) / kMedian[k], quantile(statistics, 0.9) / kNinety[k]);
}

double batches_of_prior(const std::vector<ScoreByBatches>& scores) {
  double beyond = 0.0, freedom = 0.0;
  for (const ScoreByBatches& s : scores) {
    if (s.count < kFewestToTell) continue;
    // Of white innovations (scatter - 1)^2 has the mean 2 / (count - 1).
    beyond += 0.5 * (s.count - 1.0) * (s.scatter - 1.0) * (s.scatter - 1.0) - 1.0;
    freedom += 0.5 * (s.count - 1.0);
  }
  if (freedom <= 0.0) return kFewestBatchesBelieved;
  const double variance = std::max(0.0, beyond / freedom);  // of inflations, over candidates
  return std::clamp(2.0 / std::max(variance, 1e-300), kFewestBatchesBelieved, static_cast<double>(kBatches));
}

}  // namespace odolab
