// The numbers of the joint model at which its runs are likeliest, and how well they are known.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

std::vector<int> JointModel::held_columns() const {
  std::vector<int> held;
  for (int c = 0; c < 6; ++c)
    if (untold_[static_cast<std::size_t>(c)]) held.push_back(c);
  for (std::size_t k = 0; k < accepted.size(); ++k)
    if (accepted[k].is_held)
      for (std::size_t j = 0; j < accepted[k].value.size(); ++j)
        held.push_back(first_column(static_cast<int>(k)) + static_cast<int>(j));
  if (!clocks_are_held) return held;
  for (std::size_t r = 0; r < runs_.size(); ++r) held.push_back(clock_column(static_cast<int>(r)));
  for (std::size_t k = 0; k < accepted.size(); ++k)
    if (accepted[k].effect->clock_rate)
      for (std::size_t j = 0; j < accepted[k].value.size(); ++j)
        held.push_back(first_column(static_cast<int>(k)) + static_cast<int>(j));
  return held;
}

int JointModel::columns_fitted() const {
  std::vector<char> is_fitted(static_cast<std::size_t>(columns()), 1);
  const auto leave = [&](int column) { is_fitted[static_cast<std::size_t>(column)] = 0; };
  for (int c = 0; c < 6; ++c)
    if (!nuisance_active[static_cast<std::size_t>(c)]) leave(c);
  for (std::size_t r = 0; r < runs_.size(); ++r)
    if (!clock_active[r]) leave(clock_column(static_cast<int>(r)));
  if (std::none_of(runs_.begin(), runs_.end(), [](const InnovationRun& run) { return run.counts_show; }))
    for (const int wheel : {0, 1}) leave(half_count_column(wheel));
  for (const int c : held_columns()) leave(c);
  return static_cast<int>(std::count(is_fitted.begin(), is_fitted.end(), 1));
}

double JointModel::fit(int iterations) {
  constexpr double kNothing = 1e-4;  // a hundredth of a standard deviation
  constexpr double kStraight = 0.1;  // a third: over so little the model is linear
  constexpr double kDamping = 1e-4;  // a direction of which a group is asked keeps sixteen times as much, or more
  const bool shapes_follow = std::any_of(accepted.begin(), accepted.end(), [](const AcceptedEffect& a) {
    return a.effect->shape_follows_amplitude && !a.is_held;
  });
  const std::vector<int> held = held_columns();
  linearise();
  double gained = 0.0;
  for (int i = 0; i < iterations; ++i) {
    MatrixXd gram = gram_;
    VectorXd moved_by = zr_;
    for (int c : held) {
      gram.row(c).setZero();
      gram.col(c).setZero();
      gram(c, c) = 1.0;
      moved_by(c) = 0.0;
    }
    int damped = first_amplitude();
    for (const AcceptedEffect& a : accepted) {
      const auto numbers = static_cast<int>(a.value.size());
      if (a.is_damped) gram.diagonal().segment(damped, numbers) *= 1.0 + kDamping;
      damped += numbers;
    }
    const VectorXd step = gram.ldlt().solve(moved_by), score = zr_;
    if (!step.allFinite()) break;
    const double size = step.dot(score);
    if (size < kNothing && !shapes_follow) break;
    const auto saved_accepted = accepted;
    const InnovationModel saved = model;
    const std::vector<double> saved_clock = clock_s;
    const std::array<double, 2> saved_half_counts = half_counts;
    const double before = chi2_;
    VectorXd gone;
    double scale = 1.0;
    const auto go = [&] {
      gone = scale * step;
      model = saved;
      clock_s = saved_clock;
      accepted = saved_accepted;
      for (int c = 0; c < 6; ++c) nuisance(model, c) += scale * step(c);
      for (std::size_t r = 0; r < runs_.size(); ++r) clock_s[r] += scale * step(6 + r);
      for (int w = 0; w < 2; ++w) half_counts[w] = saved_half_counts[w] + scale * step(half_count_column(w));
      int k = first_amplitude();
      for (AcceptedEffect& a : accepted) {
        for (std::size_t j = 0; j < a.value.size(); ++j, ++k) {
          const double was = a.value[j];
          a.value[j] = std::clamp(was + scale * step(k), a.effect->amplitudes[j].low, a.effect->amplitudes[j].high);
          gone(k) = a.value[j] - was;
        }
        if (a.effect->shape_follows_amplitude && !a.is_held)
          a.shape[0] = std::max(0.5 * (a.shape[0] + a.value[0]), 1e-4);
      }
    };
    if (size < kStraight && !shapes_follow) {
      go();
      for (std::size_t r = 0; r < runs_.size(); ++r) residual_[r] -= now_->z[r] * now_->acting(r, gone);
      forget_what_was_asked();
      zr_ -= gram_ * gone;
      gained += gone.dot(score + zr_);
      chi2_ -= gone.dot(score + zr_);
      linearised_at_ = standing();
      break;
    }
    for (int attempt = 0; attempt < 3; ++attempt, scale *= 0.3) {
      go();
      linearise();
      if (std::isfinite(chi2_) && chi2_ < before * 1.02 + 20.0) break;
    }
    gained += gone.dot(score + zr_);
  }
  return gained;
}

MatrixXd JointModel::covariance() const { return gram_.ldlt().solve(MatrixXd::Identity(gram_.rows(), gram_.cols())); }

double JointModel::stderr_of_nuisance(int c) const { return std::sqrt(std::max(0.0, covariance()(c, c))); }

SharedClock JointModel::shared_clock() const {
  const auto runs = static_cast<Eigen::Index>(runs_.size());
  return odolab::shared_clock(clock_s, covariance().block(clock_column(0), clock_column(0), runs, runs));
}

}  // namespace odolab
