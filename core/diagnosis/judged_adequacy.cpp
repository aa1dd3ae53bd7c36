#include "core/diagnosis/judged_adequacy.h"

#include <algorithm>

#include "core/diagnosis/generic/bursts.h"
#include "core/diagnosis/generic/contradicted.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/radii_by_way.h"
#include "core/diagnosis/generic/stretches.h"
#include "core/diagnosis/generic/truth_otherwise_since.h"
#include "core/diagnosis/naming/lag_and_delay.h"

namespace odolab {

namespace {

bool is_at_a_place(const AcceptedEffect& a) { return a.effect->local && !a.effect->of_one_recording; }

// Whether names suffice, of what they were fitted to; and of that together with what was held out, half the error each.
Adequacy judged_by_both(const Named& named, const JointModel& calibrated, const Predictor& predictor, double error) {
  const JointModel& joint = named.joint;
  const std::optional<JointModel>& all_named = named.with_held_out;
  std::vector<ScoredCandidate> evidence = named.selected.evidence;
  Adequacy adequacy = adequacy_of(joint, calibrated, evidence, all_named ? 0.5 * error : error);
  if (adequacy.unnamed || !all_named) return adequacy;
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    const AcceptedEffect& a = all_named->accepted[k];
    const double of_all = all_named->test(all_named->columns_of(*a.effect, a.shape), static_cast<int>(k)).statistic;
    evidence[k].test.statistic = std::max(evidence[k].test.statistic, of_all);
  }
  const JointModel all_calibrated = *predictor.fitted_to_all(calibrated);
  const Adequacy of_all = adequacy_of(*all_named, all_calibrated, evidence, 0.5 * error);
  adequacy.unnamed = of_all.unnamed;
  const auto first_held_out = static_cast<int>(joint.runs().size());
  if (!adequacy.unnamed) adequacy.unnamed = what_was_not_foreseen(*all_named, all_calibrated, first_held_out);
  // A patch that the others only graze is another one where it is met in full.
  if (adequacy.unnamed && !of_all.unnamed && std::any_of(joint.accepted.begin(), joint.accepted.end(), is_at_a_place)) {
    JointModel sought = *all_named;
    find_places_again(sought);
    adequacy.unnamed = what_was_not_foreseen(sought, all_calibrated, first_held_out);
  }
  if (of_all.as_likely) adequacy.as_likely = of_all.as_likely;
  adequacy.shows_beside_held_out = adequacy.unnamed.has_value();
  return adequacy;
}

// Whether it is no longer than a push, and where one was named.
bool is_a_named_push(const Unnamed& lasting, const JointModel& named) {
  constexpr double kLongest_s = 1.0, kNear_s = 0.25;
  if (lasting.where.time_s.size() != 1) return false;
  const auto [from_s, to_s] = lasting.where.time_s.front();
  return to_s - from_s < kLongest_s &&
         std::any_of(named.accepted.begin(), named.accepted.end(), [&, from_s = from_s, to_s = to_s](const auto& a) {
           return a.effect->local && a.effect->of_one_recording &&
                  named.runs()[static_cast<std::size_t>(a.shape[0])].name == lasting.where.recording &&
                  a.shape[1] > from_s - kNear_s && a.shape[1] < to_s + kNear_s;
         });
}

// What goes on for a while may have been named a patch or a bump, which the vehicle is on as long. What these say they
// say beside what else takes it up, and of the noise, too.
std::optional<Unnamed> what_goes_on_instead_of_places(const Named& named, double error) {
  double said = 0.0;
  for (const ScoredCandidate& e : named.selected.evidence)
    if (e.effect->local) said += e.test.judged();
  if (said <= 0.0) return std::nullopt;
  JointModel without = named.joint;
  std::erase_if(without.accepted, [](const AcceptedEffect& a) { return a.effect->local; });
  without.fit(3);
  without.fit_noise_and_all();
  std::optional<Unnamed> lasting = what_goes_on_for_a_while(without, 0.0, error);
  if (!lasting || lasting->gain < (1.0 + kMostLeft) * said || lasting->gain < likelier_by(named.joint, without) ||
      is_a_named_push(*lasting, named.joint))
    return std::nullopt;
  return lasting;
}

}  // namespace

Adequacy judged_adequacy(const Named& named, const JointModel& calibrated, const Predictor& predictor,
                         const FittedNoise& of_calibration, double error) {
  Adequacy adequacy = judged_by_both(named, calibrated, predictor, error);
  if (named.joint.scalars_on_the_way() == 0) {  // who never drives tells nothing of how
    adequacy.unnamed.reset();
    adequacy.as_likely.reset();
    adequacy.sway.reset();
    return adequacy;
  }
  if (!adequacy.unnamed) adequacy.unnamed = what_contradicts(named.joint, calibrated, of_calibration);
  if (!adequacy.unnamed || adequacy.unnamed->component != "truth")
    if (std::optional<Unnamed> since = what_is_otherwise_since(named.joint, named.selected.evidence))
      adequacy.unnamed = std::move(since);
  if (!adequacy.unnamed || adequacy.unnamed->component != "truth") {
    constexpr double kFarMore = 2.0;  // gains are under noise of their own
    std::optional<Unnamed> law = what_radii_go_by_instead(named.joint);
    if (law && (!adequacy.unnamed || law->gain > kFarMore * adequacy.unnamed->gain)) adequacy.unnamed = std::move(law);
  }
  if (!adequacy.unnamed) adequacy.unnamed = what_happens_too_often(named.joint);
  double explained = 0.0;
  for (const ScoredCandidate& e : named.selected.evidence)
    explained += counted_for_the_unnamed(*e.effect, e.test.statistic);
  if (!adequacy.unnamed) {
    adequacy.unnamed = what_comes_in_bursts(named.joint, explained, error);
    std::optional<Unnamed> lasting = what_goes_on_for_a_while(named.joint, explained, error);
    if (lasting && (!adequacy.unnamed || lasting->p_value < adequacy.unnamed->p_value)) adequacy.unnamed = lasting;
    if (!adequacy.unnamed) adequacy.unnamed = what_goes_on_instead_of_places(named, error);
  }
  if (!adequacy.unnamed) adequacy.unnamed = what_scatters_too_much(named.joint);
  if (!adequacy.unnamed) adequacy.unnamed = what_no_noise_makes(named.joint, calibrated);
  if (!adequacy.unnamed) adequacy.unnamed = what_so_many_names_stand_for(named.joint.accepted, named.selected.evidence);
  return adequacy;
}

}  // namespace odolab
