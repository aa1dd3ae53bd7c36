// The joint model of fewer runs than it was fitted to, and of more.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

JointModel JointModel::left_out(int run) const {
  MatrixXd own = MatrixXd::Zero(gram_.rows(), gram_.cols());
  VectorXd own_zr = VectorXd::Zero(zr_.size());
  add_products(run, own, own_zr);
  MatrixXd gram = gram_ - own;
  VectorXd zr = zr_ - own_zr;
  JointModel one;  // of that run: a copy of all runs would cost more than the step
  one.model = model;
  one.half_counts = half_counts;
  one.nuisance_active = nuisance_active;
  one.clocks_are_held = clocks_are_held;
  one.nominal_ = nominal_;
  one.mean_radius_is_held_ = mean_radius_is_held_;
  one.untold_ = untold_;
  // What only this run could tell is not known from the others; nor is what they do not tell from nothing, so that it
  // would come out as anything: without the one run that goes back, a drag is any radius. All else is fitted without
  // it.
  constexpr double kLeastSigmas = 3.0;
  const MatrixXd known_by_others = gram.ldlt().solve(MatrixXd::Identity(gram.rows(), gram.cols()));
  std::vector<char> unknown(gram.rows(), 0);
  for (Eigen::Index c = 0; c < gram.rows(); ++c) unknown[c] = gram(c, c) < 1e-6 * gram_(c, c);
  int amplitude = first_amplitude();
  std::vector<char> held(gram.rows(), 0);
  for (std::size_t c = 0; c < untold_.size(); ++c) held[c] = untold_[c];
  for (const AcceptedEffect& a : accepted) {
    if (a.is_held) {  // as all of them say
      for (std::size_t j = 0; j < a.value.size(); ++j) held[static_cast<std::size_t>(amplitude++)] = 1;
      continue;
    }
    double sigmas = 0.0;
    for (std::size_t j = 0; j < a.value.size(); ++j) {
      const Eigen::Index c = amplitude + static_cast<int>(j);
      sigmas = std::max(sigmas, std::abs(a.value[j]) / std::sqrt(std::max(known_by_others(c, c), 1e-300)));
    }
    for (std::size_t j = 0; j < a.value.size(); ++j, ++amplitude) {
      if (sigmas < kLeastSigmas && a.acts_on_motion()) unknown[amplitude] = 1;
      if (!unknown[amplitude]) continue;
      zr += gram.col(amplitude) * a.value[j];
      const std::vector<int>& acting = now_->columns[run];
      const bool at_one_moment = a.effect->of_one_recording && a.effect->local;
      if (!at_one_moment && std::find(acting.begin(), acting.end(), amplitude) != acting.end()) one.is_foretold = false;
    }
  }
  for (Eigen::Index c = 0; c < gram.rows(); ++c)
    if (unknown[c] || held[static_cast<std::size_t>(c)]) {
      gram.row(c).setZero();
      gram.col(c).setZero();
      gram(c, c) = 1.0;
      zr(c) = 0.0;
    }
  const VectorXd step = gram.ldlt().solve(zr);
  if (step.allFinite())
    for (int c = 0; c < 6; ++c) nuisance(one.model, c) += step(c);
  if (step.allFinite())
    for (int w = 0; w < 2; ++w) one.half_counts[w] += step(half_count_column(w));
  int k = first_amplitude();
  for (AcceptedEffect a : accepted) {
    bool known = true;
    for (std::size_t j = 0; j < a.value.size(); ++j, ++k) {
      if (a.effect->clock_rate && a.effect->of_each_recording) continue;  // each clock is its own
      const Effect::Amplitude& bounds = a.effect->amplitudes[j];
      a.value[j] =
          unknown[k] ? 0.0 : std::clamp(a.value[j] + (step.allFinite() ? step(k) : 0.0), bounds.low, bounds.high);
      known = known && !unknown[k];
    }
    if (known || !a.effect->of_one_recording) one.accepted.push_back(a);
  }
  const auto keep = [run](auto& into, const auto& of) { into = {of[static_cast<std::size_t>(run)]}; };
  keep(one.runs_, runs_);
  keep(one.numbers_, numbers_);
  keep(one.from_commands_, from_commands_);
  keep(one.masked_, masked_);
  keep(one.clock_s, clock_s);
  keep(one.clock_active, clock_active);
  const auto kept = std::make_shared<Linearisation>();
  keep(kept->runs, now_->runs);  // where it was is where its effects act
  one.now_ = kept;
  one.linearise(false);
  return one;
}

double JointModel::lost_without(int accepted_effect, JointModel* kept) const {
  JointModel without = *this;
  without.accepted.erase(without.accepted.begin() + accepted_effect);
  without.fit(4);
  const double lost = without.minus_two_log_likelihood() - minus_two_log_likelihood();
  if (kept) *kept = std::move(without);
  return lost;
}

JointModel JointModel::together_with(const JointModel& others) const {
  JointModel all = *this;
  all.untold_ = {};  // the others may tell
  const auto append = [](auto& to, const auto& of) { to.insert(to.end(), of.begin(), of.end()); };
  append(all.runs_, others.runs_);
  append(all.from_commands_, others.from_commands_);
  append(all.masked_, others.masked_);
  append(all.clock_s, others.clock_s);
  append(all.clock_active, others.clock_active);
  for (std::size_t r = numbers_.size(); r < all.runs_.size(); ++r) all.numbers_.push_back(static_cast<int>(r));
  // What happened in one recording alone is not among the others' names.
  const auto are_clocks = [](const AcceptedEffect& a) { return a.effect->clock_rate && a.effect->of_each_recording; };
  for (AcceptedEffect& a : all.accepted) {
    if (!are_clocks(a)) continue;
    a.effect = &effects::clock_rate_of_each_run(static_cast<int>(all.runs_.size())).front();
    const auto theirs = std::find_if(others.accepted.begin(), others.accepted.end(), are_clocks);
    append(a.value, theirs == others.accepted.end() ? std::vector<double>(others.runs_.size(), 0.0) : theirs->value);
  }
  const auto where_they_are = std::make_shared<Linearisation>();
  where_they_are->runs = now_->runs;
  append(where_they_are->runs, others.now_->runs);
  all.now_ = where_they_are;
  all.linearised_at_.reset();
  return all;
}

}  // namespace odolab
