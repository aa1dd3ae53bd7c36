#include "core/calibration/stretch_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/quantile.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDeterminedShare = 0.2;  // of the prior's width, at most
constexpr double kHuber = 3.0;            // residuals beyond so many standard deviations count less: bumps
constexpr int kIterations = 12;

VectorXd contradictions(const StretchProblem& problem, int stretch, const std::vector<double>& x) {
  const std::vector<double> found = problem.contradictions(stretch, x);
  return Eigen::Map<const VectorXd>(found.data(), static_cast<Eigen::Index>(found.size()));
}

// A robust standard deviation of each contradiction, no smaller than the encoders' rounding at both ends.
VectorXd deviations(const std::vector<VectorXd>& residuals, const std::vector<double>& least) {
  VectorXd result(static_cast<Eigen::Index>(least.size()));
  for (int k = 0; k < result.size(); ++k) {
    std::vector<double> of_one;
    for (const VectorXd& r : residuals) of_one.push_back(r[k]);
    result[k] = std::max({scatter_about_zero(std::move(of_one)), least[static_cast<std::size_t>(k)], 1e-7});
  }
  return result;
}

// How the contradictions of one stretch answer to every unknown, by differences.
MatrixXd jacobian_of(const StretchProblem& problem, int stretch, const std::vector<double>& x) {
  constexpr double kStep = 1e-5;
  MatrixXd jacobian(static_cast<Eigen::Index>(problem.least_deviation.size()), static_cast<Eigen::Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::vector<double> more = x, less = x;
    more[k] += kStep;
    less[k] -= kStep;
    jacobian.col(static_cast<Eigen::Index>(k)) =
        (contradictions(problem, stretch, more) - contradictions(problem, stretch, less)) / (2.0 * kStep);
  }
  return jacobian;
}

// The linearised problem about one x, all unknowns, without the priors.
struct Normal {
  explicit Normal(Eigen::Index unknowns)
      : information(MatrixXd::Zero(unknowns, unknowns)),
        gradient(VectorXd::Zero(unknowns)),
        spread(MatrixXd::Zero(unknowns, unknowns)) {}
  MatrixXd information;
  VectorXd gradient;
  MatrixXd spread;  // of the gradient, from its scatter and from rounding
};

// Rounding at the end of one stretch is that at the start of the next: the scores are correlated (Newey, West 1987).
void add_scatter(const std::vector<VectorXd>& scores, MatrixXd& spread) {
  constexpr std::size_t kLags = 2;
  for (std::size_t lag = 0; lag <= kLags; ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / (kLags + 1);
    for (std::size_t i = lag; i < scores.size(); ++i) {
      const MatrixXd product = weight * scores[i] * scores[i - lag].transpose();
      spread += product;
      if (lag > 0) spread += product.transpose();
    }
  }
}

// Joints that hold an angle hold its rounding: all readings of one step of an encoder may err alike.
class RoundingByStep {
 public:
  explicit RoundingByStep(double step) : step_(step) {}
  void add(double reading, const VectorXd& effect) {
    if (step_ <= 0.0) return;
    const auto [entry, is_new] = effects_.emplace(std::llround(reading / step_), effect);
    if (!is_new) entry->second += effect;
  }
  void add_to(MatrixXd& spread) const {
    for (const auto& [step, effect] : effects_) spread += step_ * step_ / 12.0 * effect * effect.transpose();
  }

 private:
  double step_;
  std::map<long long, VectorXd> effects_;
};

Normal normal_equations(const StretchProblem& problem, const std::vector<double>& x) {
  std::vector<VectorXd> residuals;
  for (int i = 0; i < problem.stretches; ++i) residuals.push_back(contradictions(problem, i, x));
  const VectorXd sigma = deviations(residuals, problem.least_deviation);
  Normal normal(static_cast<Eigen::Index>(x.size()));
  std::vector<VectorXd> scores;
  std::vector<RoundingByStep> rounding;
  for (const StretchProblem::Encoder& encoder : problem.encoders) rounding.emplace_back(encoder.step);
  for (int i = 0; i < problem.stretches; ++i) {
    const VectorXd& residual = residuals[static_cast<std::size_t>(i)];
    const MatrixXd jacobian = jacobian_of(problem, i, x);
    VectorXd weight(residual.size());
    for (int row = 0; row < residual.size(); ++row) {
      const double z = std::abs(residual[row]) / sigma[row];
      weight[row] = (z <= kHuber ? 1.0 : kHuber / z) / (sigma[row] * sigma[row]);
    }
    const MatrixXd weighted = jacobian.transpose() * weight.asDiagonal();
    normal.information += weighted * jacobian;
    scores.push_back(-weighted * residual);
    normal.gradient += scores.back();
    // A reading acts at the stretch's end directly; an offset acts at both ends, which tells how one at the start does.
    for (std::size_t e = 0; e < problem.encoders.size(); ++e) {
      const StretchProblem::Encoder& encoder = problem.encoders[e];
      const VectorXd at_end = weighted.col(encoder.contradiction);
      rounding[e].add(encoder.reading(i, true), at_end);
      rounding[e].add(encoder.reading(i, false), -at_end - weighted * jacobian.col(encoder.offset));
    }
  }
  add_scatter(scores, normal.spread);
  for (const RoundingByStep& encoder : rounding) encoder.add_to(normal.spread);
  return normal;
}

}  // namespace

bool StretchFit::determined(int unknown) const {
  const std::size_t k = static_cast<std::size_t>(unknown);
  const double variance = covariance[k * x.size() + k];
  return variance > 0.0 && std::sqrt(variance) < kDeterminedShare * prior[k];
}

double StretchFit::variance_along(const std::vector<double>& slope) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k) sum += slope[i] * covariance[i * x.size() + k] * slope[k];
  return sum;
}

StretchFit fit_stretches(const StretchProblem& problem, const std::vector<int>& free, const Progress& progress) {
  const std::size_t unknowns = problem.prior.size();
  const Eigen::Index all = static_cast<Eigen::Index>(unknowns), n = static_cast<Eigen::Index>(free.size());
  MatrixXd choice = MatrixXd::Zero(all, n);  // the free ones among all
  for (Eigen::Index k = 0; k < n; ++k) choice(free[static_cast<std::size_t>(k)], k) = 1.0;
  MatrixXd of_prior = MatrixXd::Zero(all, all);
  for (Eigen::Index k = 0; k < all; ++k) {
    const double width = problem.prior[static_cast<std::size_t>(k)];
    of_prior(k, k) = 1.0 / (width * width);
  }
  StretchFit fit;
  fit.prior = problem.prior;
  fit.x.assign(unknowns, 0.0);
  MatrixXd covariance = MatrixXd::Zero(all, all);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (!goes_on(progress, static_cast<double>(iteration) / kIterations)) break;
    const Normal normal = normal_equations(problem, fit.x);
    const Eigen::Map<const VectorXd> x(fit.x.data(), all);
    const MatrixXd inverse = (choice.transpose() * (normal.information + of_prior) * choice).inverse();
    const VectorXd step = inverse * choice.transpose() * (normal.gradient - of_prior * x);
    covariance =
        choice * inverse * (choice.transpose() * (normal.spread + of_prior) * choice) * inverse * choice.transpose();
    const VectorXd change = choice * step;
    for (std::size_t k = 0; k < unknowns; ++k) fit.x[k] += change[static_cast<Eigen::Index>(k)];
    if (step.cwiseAbs().maxCoeff() < 1e-9) break;
  }
  for (Eigen::Index i = 0; i < all; ++i)
    for (Eigen::Index k = 0; k < all; ++k) fit.covariance.push_back(covariance(i, k));
  return fit;
}

}  // namespace odolab
