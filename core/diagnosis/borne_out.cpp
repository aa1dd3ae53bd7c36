#include "core/diagnosis/borne_out.h"

#include <algorithm>

#include "core/diagnosis/naming/own_noise.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

namespace {

// In the place of the k-th accepted effect, under the noise that its model leaves; of few innovations, under what is
// left without it, unless it is beyond doubt: without what is large no fit is linear.
CandidateTest tested_in_place(const JointModel& of_all, std::size_t k, const Effect& effect,
                              const std::vector<double>& shape) {
  CandidateTest test = of_all.test(of_all.columns_of(effect, shape), static_cast<int>(k));
  if (of_all.scalars() > kFewestToTellNoise || test.statistic > kDecisive) return test;
  JointModel without = of_all;
  of_all.lost_without(static_cast<int>(k), &without);
  without.fit_noise_and_all();
  return without.test(without.columns_of(effect, shape));
}

// A name's evidence in all recordings together, those held out among them, by its own count of tries: in the place of
// the k-th accepted effect.
ScoredCandidate of_all_recordings(const JointModel& of_all, std::size_t k, ScoredCandidate c, const Effect& effect,
                                  const std::vector<double>& shape) {
  const CandidateTest of = tested_in_place(of_all, k, effect, shape);
  const AcceptedEffect& accepted = of_all.accepted[k];
  const bool is_itself = accepted.is_held && accepted.effect == &effect;
  c.test.statistic = is_itself ? of_all.lost_without(static_cast<int>(k)) : of.statistic;
  c.test.freedom = of.freedom;
  judge(c);
  return c;
}

// Names that recordings only hint at, which those held out bear out: each is beyond chance in all recordings together,
// and more so than in those that it was fitted to. Its evidence is then that of all. What held-out recordings cannot
// bear out is not named: one moment, a load, a phase of each recording.
bool are_borne_out(const Predictor& predictor, const JointModel& joint, Selected& hinted, double family_wise_error) {
  for (const AcceptedEffect& a : joint.accepted)
    if (a.effect->of_one_recording || a.effect->of_each_recording) return false;
  const std::optional<JointModel> of_all = predictor.fitted_to_all(joint);
  if (!of_all) return false;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    const AcceptedEffect& a = of_all->accepted[k];
    const ScoredCandidate all = of_all_recordings(*of_all, k, hinted.evidence[k], *a.effect, a.shape);
    if (all.p_value >= family_wise_error || all.test.judged() <= hinted.evidence[k].test.judged()) return false;
    hinted.evidence[k].p_value = all.p_value;
  }
  return true;
}

}  // namespace

std::optional<std::size_t> not_borne_out(const JointModel& of_all, const Selected& selected, double family_wise_error) {
  std::optional<std::size_t> weakest;
  double most = family_wise_error;
  for (std::size_t k = 0; k < of_all.accepted.size(); ++k) {
    const AcceptedEffect& a = of_all.accepted[k];
    double p = of_all_recordings(of_all, k, selected.evidence[k], *a.effect, a.shape).p_value;
    // Of each recording there are as many numbers as recordings.
    for (const ScoredCandidate& other : selected.alternatives[k])
      if (!other.effect->of_each_recording)
        p = std::min(p, of_all_recordings(of_all, k, other, *other.effect, other.test.shape).p_value);
    if (p > most) most = p, weakest = k;
  }
  return weakest;
}

bool name_what_is_hinted_at(JointModel& joint, Selected& selected, const Predictor& predictor, double family_wise_error,
                            const Progress& go_on) {
  constexpr double kHint = 0.5;  // of as many such names as chance would bring up, if nothing is missing
  if (std::none_of(selected.first_look.begin(), selected.first_look.end(),
                   [](const ScoredCandidate& c) { return c.p_value < kHint; }))
    return false;
  JointModel hinted_at = joint;
  Selected hinted = select_effects(hinted_at, kHint, go_on);
  if (hinted_at.accepted.empty() || !are_borne_out(predictor, hinted_at, hinted, family_wise_error)) return false;
  joint = std::move(hinted_at);
  selected = std::move(hinted);
  return true;
}

}  // namespace odolab
