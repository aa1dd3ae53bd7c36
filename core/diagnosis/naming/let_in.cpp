#include "core/diagnosis/naming/let_in.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/model/driven_again.h"
#include "core/diagnosis/naming/lag_and_delay.h"
#include "core/diagnosis/naming/one_cause.h"
#include "core/diagnosis/naming/own_noise.h"

namespace odolab {

namespace {

// That of the other wheel.
const Effect& other_wheels(const Effect& of_one) {
  const bool is_left = of_one.component == component_of(Wheel::left);
  return *catalogue_entry({of_one.name, component_of(is_left ? Wheel::right : Wheel::left), {}});
}

}  // namespace

double let_in(JointModel& joint, const ScoredCandidate& c) {
  AcceptedEffect a;
  a.effect = c.effect;
  a.shape = c.test.shape;
  if (c.effect->shape_follows_amplitude) a.shape[0] = std::max(c.test.value[0], 1e-4);
  a.value.assign(c.test.value.size(), 0.0);
  const auto coarser = std::find_if(joint.accepted.begin(), joint.accepted.end(),
                                    [&](const AcceptedEffect& other) { return is_finer(*a.effect, *other.effect); });
  if (coarser != joint.accepted.end()) {
    for (std::size_t k = 0; k < a.value.size(); ++k) a.value[k] = coarser->value[k % coarser->value.size()];
    joint.accepted.erase(coarser);
  }
  // What was said of both wheels is of each by itself, at first as large in one as in the other.
  const auto both = std::find_if(joint.accepted.begin(), joint.accepted.end(),
                                 [&](const AcceptedEffect& other) { return is_within(*a.effect, *other.effect); });
  if (both != joint.accepted.end()) {
    a.value = both->value;
    a.shape = both->shape;
    both->effect = &other_wheels(*a.effect);
  }
  const double without = c.effect->only_commands ? joint.minus_two_log_likelihood() : 0.0;
  joint.accepted.push_back(a);
  double gained = joint.fit(3);
  // A shape that is the amplitude itself follows it by halves, and a lag goes a long way against the clock's offset.
  constexpr int kMostRounds = 8;
  constexpr double kSettled = 0.02;
  const auto settled = [&] {
    const AcceptedEffect& now = joint.accepted.back();
    return !now.effect->shape_follows_amplitude ||
           std::abs(now.shape[0] - now.value[0]) < kSettled * std::max(now.shape[0], 1e-3);
  };
  for (int round = 0; round < kMostRounds && !settled(); ++round) gained += joint.fit(3);
  if (!c.effect->only_commands) return gained;
  put_lag_where_likeliest(joint);
  return without - joint.minus_two_log_likelihood();
}

void look_again(const JointModel& joint, std::vector<ScoredCandidate>& scored) {
  constexpr std::size_t kMost = 3;
  constexpr double kWorthALook = 8.0;                      // of the statistic
  constexpr double kCertain = -16.0, kOnceByChance = 0.0;  // of the logarithm of its p value
  constexpr double kGivenToAnyTerm =
      1.05;  // by which noise makes a term larger where nothing is missing, 19 in 20 times
  const auto tail = [](const ScoredCandidate* c) {
    return std::log(std::max(chi_square_tail(c->test.judged(), c->test.freedom), 1e-300)) + c->log_tests;
  };
  std::vector<ScoredCandidate*> nearest;
  for (ScoredCandidate& c : scored) {
    if (!c.beyond_counts || c.test.judged() <= kWorthALook || of_the_same(joint, c)) continue;
    if (tail(&c) < kCertain) return;
    if (!c.effect->of_one_recording && tail(&c) < kOnceByChance) nearest.push_back(&c);
  }
  std::stable_sort(nearest.begin(), nearest.end(), [&](const auto* a, const auto* b) { return tail(a) < tail(b); });
  if (nearest.size() > kMost) nearest.resize(kMost);
  parallel_for(static_cast<int>(nearest.size()), [&](int i) {
    ScoredCandidate& c = *nearest[static_cast<std::size_t>(i)];
    JointModel with = joint;
    let_in(with, c);
    const CandidateTest again = scored_under_own_noise(with, !c.effect->local);
    c.test.statistic = again.statistic / kGivenToAnyTerm;
    if (!c.effect->local) {
      c.test.inflation = again.inflation;
      if (c.test.feigned.more > 0.0)
        c.test.widen(joint.driven_again->feigned(*c.effect, c.test.shape, with.model.noise));
      c.test.cross_validated = again.cross_validated;
    }
    judge(c);
  });
}

}  // namespace odolab
