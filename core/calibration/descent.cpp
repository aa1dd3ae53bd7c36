#include "core/calibration/descent.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <deque>

namespace odolab {

namespace {

// A step, and by how much the slope changed over it.
struct Pair {
  Eigen::VectorXd step, slope;
};

// The curvature corrected by what was seen of it (BFGS); stays positive definite.
Eigen::MatrixXd corrected(Eigen::MatrixXd b, const std::deque<Pair>& seen) {
  constexpr double kLeast = 1e-3, kMost = 1e3;  // of the curvature along the step: beyond it is no parabola
  for (const Pair& p : seen) {
    const Eigen::VectorXd by = b * p.step;
    const double expected = p.step.dot(by), found = p.step.dot(p.slope);
    if (!(found > kLeast * expected && found < kMost * expected)) continue;
    b += p.slope * p.slope.transpose() / found - by * by.transpose() / expected;
  }
  return b;
}

// The step to the least of the parabola within a region of trust (K. Levenberg 1944): no variable moves by more than
// `longest`. What hardly bends the function is held back, and what bends it goes on as far as it would.
Eigen::VectorXd step_within(double longest, const Eigen::MatrixXd& curvature, const Eigen::VectorXd& slope) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(curvature);
  const Eigen::VectorXd along = axes.eigenvectors().transpose() * slope;
  const auto step = [&](double damping) -> Eigen::VectorXd {
    return -(axes.eigenvectors() * (along.array() / (axes.eigenvalues().array() + damping)).matrix());
  };
  double enough = slope.norm() / longest, too_little = 0.0;  // a step is no longer than slope / damping
  for (int i = 0; i < 30 && enough > 1.1 * too_little; ++i) {
    const double damping = too_little > 0.0 ? std::sqrt(enough * too_little) : 1e-3 * enough;
    (step(damping).cwiseAbs().maxCoeff() <= longest ? enough : too_little) = damping;
  }
  return step(enough);
}

}  // namespace

std::vector<double> descended(const std::function<Sloped(std::vector<double>& at)>& function, std::vector<double> start,
                              const DescentLimits& limits) {
  constexpr double kArmijo = 1e-3;  // share of what the slope promises that a step must keep
  constexpr std::size_t kMostSeen = 6;
  constexpr double kShort = 0.3;  // over longer steps the curvature changes by itself
  const auto n = static_cast<Eigen::Index>(start.size());
  std::vector<double> best = std::move(start);
  Sloped here = function(best);
  std::deque<Pair> seen;
  for (int calls = 1; calls < limits.most_calls;) {
    const Eigen::Map<const Eigen::VectorXd> slope(here.slope.data(), n);
    const Eigen::Map<const Eigen::MatrixXd> curvature(here.curvature.data(), n, n);
    const Eigen::MatrixXd seen_curvature = corrected(curvature, seen);
    Eigen::VectorXd step = seen_curvature.ldlt().solve(-slope);
    double promised = -step.dot(slope);  // by the slope alone; twice what slope and curvature promise
    if (!std::isfinite(promised) || promised <= 0.0) break;
    const auto moved_by = [&](double share) {
      std::vector<double> at = best;
      for (Eigen::Index k = 0; k < n; ++k) at[static_cast<std::size_t>(k)] += share * step(k);
      return at;
    };
    const double longest = step.cwiseAbs().maxCoeff();
    const double by_the_curvature_given = slope.dot(curvature.ldlt().solve(slope));
    if (0.5 * std::max(promised, by_the_curvature_given) < limits.least_gain)
      return longest < limits.longest_step ? moved_by(1.0) : best;
    if (longest > limits.longest_step) {
      step = step_within(limits.longest_step, seen_curvature, slope);
      promised = -step.dot(slope);
    }
    bool accepted = false;
    for (double share = 1.0; calls < limits.most_calls && share * promised > kArmijo * limits.least_gain;) {
      std::vector<double> at = moved_by(share);
      Sloped there = function(at);
      ++calls;
      const double gained = here.value - there.value;
      if (std::isfinite(there.value) && gained >= kArmijo * share * promised) {
        accepted = true;
        Pair pair{Eigen::VectorXd(n), Eigen::VectorXd(n)};
        for (Eigen::Index k = 0; k < n; ++k) {
          const auto i = static_cast<std::size_t>(k);
          const bool held = here.slope[i] == 0.0 || there.slope[i] == 0.0;
          pair.step(k) = held ? 0.0 : at[i] - best[i];
          pair.slope(k) = held ? 0.0 : there.slope[i] - here.slope[i];
        }
        if (pair.step.cwiseAbs().maxCoeff() < kShort)
          seen.push_back(std::move(pair));
        else
          seen.clear();
        if (seen.size() > kMostSeen) seen.pop_front();
        best = std::move(at);
        here = std::move(there);
        break;
      }
      // Least of the parabola through what is known.
      const double parabola = 0.5 * share * share * promised / (share * promised - gained);
      share = std::isfinite(parabola) ? std::clamp(parabola, 0.1 * share, 0.5 * share) : 0.1 * share;
    }
    if (!accepted) break;
  }
  return best;
}

}  // namespace odolab
