#include "core/diagnosis/naming/standing.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/model/driven_again.h"
#include "core/diagnosis/naming/compared_names.h"
#include "core/diagnosis/naming/one_cause.h"

namespace odolab {

namespace {

// A form is never quite that of the world: what is left of a strong effect is not another one, the less so one that
// looks like it.
constexpr double kLeastShare = 0.01, kLeastShareOfEvents = 0.03, kLeastShareBesideItsLike = 0.05;

}  // namespace

double least_share(const JointModel& joint, const Effect& effect, const CandidateTest& test, double distrust) {
  if (effect.local && !test.value.empty() && happens_within_another(joint, effect, test)) return kFormError;
  if (std::any_of(joint.accepted.begin(), joint.accepted.end(),
                  [&](const AcceptedEffect& a) { return looks_like(*a.effect, effect); }))
    return kLeastShareBesideItsLike;
  return effect.local ? kLeastShareOfEvents : std::lerp(kLeastShare, kLeastShareOfEvents, distrust);
}

ScoredCandidate tested_alone(const JointModel& joint, std::size_t accepted) {
  const AcceptedEffect& a = joint.accepted[accepted];
  ScoredCandidate c;
  c.effect = a.effect;
  c.test = joint.test(joint.columns_of(*a.effect, a.shape), static_cast<int>(accepted), true);
  c.test.shape = a.shape;
  widen_by_readings(c.test, joint, *a.effect, a.shape);
  judge(c);
  return c;
}

void judge_locals_by(const std::vector<ScoredCandidate>& with_all, std::vector<ScoredCandidate>& left_out) {
  for (ScoredCandidate& c : left_out) {
    if (!c.effect->local) continue;
    for (const ScoredCandidate& other : with_all)
      if (other.effect == c.effect) c.test.inflation = other.test.inflation;
    judge(c);
  }
}

bool stands(const ScoredCandidate& c, double family_wise_error) {
  return c.p_value < family_wise_error && c.test.cross_validated > 0.0 && c.beyond_counts;
}

double distrust_of(const JointModel& joint, const ScoredCandidate& c, double family_wise_error) {
  constexpr double kPerOdds = 2.0;  // at most: a factor without bounds as the correlation nears what is not believed
  const double distrust = joint.distrust(c.effect->local);
  if (distrust == 0.0 || distrust >= 1.0) return distrust;
  ScoredCandidate doubted = c;
  doubted.test.inflation *= std::min(1.0 + kPerOdds * distrust / (1.0 - distrust), joint.wider_by_correlation());
  judge(doubted);
  return doubted.p_value < family_wise_error ? 0.0 : distrust;
}

bool is_at_its_bound(const AcceptedEffect& a) {
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    const Effect::Amplitude& of = a.effect->amplitudes[k];
    if (a.value[k] != 0.0 && (a.value[k] <= of.low || a.value[k] >= of.high)) return true;
  }
  return false;
}

}  // namespace odolab
