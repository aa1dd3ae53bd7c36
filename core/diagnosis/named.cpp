#include "core/diagnosis/named.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/diagnosis/chosen_by_unseen.h"
#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/naming/in_each_run.h"
#include "core/diagnosis/naming/left_by_form.h"
#include "core/diagnosis/naming/shape_search.h"

namespace odolab {

namespace {

// Well away from nothing and, where it is one moment, from all that is left out and from both ends of its recording.
bool stands_out(const JointModel& joint, const Intervals& intervals, std::size_t k) {
  constexpr double kByChance = 0.0027;  // of three standard errors
  const AcceptedEffect& a = joint.accepted[k];
  if (a.effect->local && a.effect->of_one_recording && !joint.is_well_inside(static_cast<int>(a.shape[0]), a.shape[1]))
    return false;
  return chi_square_tail(intervals.from_nothing[k], static_cast<int>(a.value.size())) < kByChance;
}

std::vector<double> inflations_of(const Selected& selected) {
  std::vector<double> inflations;
  for (const ScoredCandidate& e : selected.evidence) inflations.push_back(e.test.inflation);
  return inflations;
}

// Of a name that does not stand out, the one to take out: what shares its evidence and says less, where that alone had
// made its size uncertain, or else itself.
std::size_t to_take_out(const JointModel& joint, const Selected& selected, std::size_t k) {
  const auto says = [&](std::size_t j) { return selected.evidence[j].test.judged(); };
  for (std::size_t j = 0; j < joint.accepted.size(); ++j) {
    if (j == k || says(j) >= says(k) || !joint.accepted[j].acts_on_motion()) continue;
    JointModel without = joint;
    without.accepted.erase(without.accepted.begin() + static_cast<std::ptrdiff_t>(j));
    without.fit(3);
    without.fit_noise_and_all();
    std::vector<double> inflations = inflations_of(selected);
    inflations.erase(inflations.begin() + static_cast<std::ptrdiff_t>(j));
    const Intervals intervals = refined(without, inflations);
    if (stands_out(without, intervals, j < k ? k - 1 : k)) return j;
  }
  return k;
}

// What each name says once another was taken out.
void ask_again(const JointModel& joint, Selected& selected) {
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    const AcceptedEffect& a = joint.accepted[k];
    if (a.is_held) continue;
    ScoredCandidate& c = selected.evidence[k];
    const CandidateTest again = joint.test(joint.columns_of(*a.effect, a.shape), static_cast<int>(k), !a.effect->local);
    c.test.statistic = again.statistic;
    if (!a.effect->local) c.test.inflation = again.inflation;
    judge(c);
  }
}

// A name's evidence in all recordings together, those held out among them, by its own count of tries: in the place of
// the k-th accepted effect.
ScoredCandidate of_all_recordings(const JointModel& of_all, std::size_t k, ScoredCandidate c, const Effect& effect,
                                  const std::vector<double>& shape) {
  const CandidateTest of = of_all.test(of_all.columns_of(effect, shape), static_cast<int>(k));
  const AcceptedEffect& accepted = of_all.accepted[k];
  const bool is_itself = accepted.is_held && accepted.effect == &effect;
  c.test.statistic = is_itself ? of_all.lost_without(static_cast<int>(k)) : of.statistic;
  c.test.freedom = of.freedom;
  judge(c);
  return c;
}

// Of the accepted effects the one that is no more than chance in all recordings together, nor is what it may be
// instead.
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

// Where nothing stands: names that are hinted at and borne out are let in, or nothing is changed.
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

// Whether the tracked point sits where the vehicle's file has it, as far as a hand puts it there.
bool sits_as_given(const JointModel& joint, const Vehicle& nominal) {
  const Pose &now = joint.model.truth.axle_T_tracked, &given = nominal.truth.axle_T_tracked;
  const double least_m = sits_right_m(std::get<DifferentialDrive>(nominal.kind).wheelbase_m);
  const auto is_there = [&](int column, double by_m) {
    return std::abs(by_m) < std::max(least_m, kSigmasOfBias * joint.stderr_of_nuisance(column));
  };
  return is_there(3, now.x_m - given.x_m) && is_there(4, now.y_m - given.y_m);
}

JointModel in_form(JointModel joint, std::size_t name, std::size_t form, const CandidateTest& test) {
  joint.accepted[name].shape.back() = static_cast<double>(form);
  joint.accepted[name].value = test.value;
  joint.fit(3);
  joint.fit_noise_and_all();
  return joint;
}

// A form that says as much with less is taken where it is not plainly less likely: what warms towards an end begins
// twice as fast as what warms for ever, and the first minutes do not tell them apart; and slip that grows with the
// speed twice, beside a tracked point that was moved, is at two speeds slip that grows with it once.
void take_simpler_forms(JointModel& joint, Selected& selected, const Vehicle& nominal) {
  constexpr double kPlainly = 4.0;   // of twice the log-likelihood: two standard errors
  constexpr double kOfForms = 0.05;  // of an amplitude, by which no form is the world's
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    const AcceptedEffect& a = joint.accepted[k];
    const bool has_simpler = !a.effect->simpler_form.empty();
    const bool may_move_the_point = a.effect->forms.size() > 1 && a.shape.size() == 1 && !a.is_held;
    if (!has_simpler && (!may_move_the_point || sits_as_given(joint, nominal))) continue;
    const auto own = static_cast<std::size_t>(a.shape.back());
    const std::size_t simpler = has_simpler ? static_cast<std::size_t>(a.effect->simpler_form[own]) : 0;
    if (simpler == own) continue;
    const CandidateTest test = tested_in_form(joint, k, simpler);
    std::vector<double> shape = a.shape;
    shape.back() = static_cast<double>(simpler);
    const double as_it_is = tested_in_form(joint, k, own).statistic;
    const double plainly =
        std::max(kPlainly * selected.evidence[k].test.inflation, has_simpler ? 0.0 : kOfForms * kOfForms * as_it_is);
    if (test.statistic < as_it_is - plainly || !is_physical(joint, *a.effect, test.value, shape)) continue;
    JointModel instead = in_form(joint, k, simpler, test);
    if (!has_simpler && !sits_as_given(instead, nominal)) continue;
    joint = std::move(instead);
    selected.evidence[k].test.shape = joint.accepted[k].shape;
  }
}

std::string name_in_words(const Effect& effect) {
  std::string name = effect.name + (effect.component.rfind("both", 0) == 0 ? " of " : " of the ") + effect.component;
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// What whole counts may feign is not named; but that it may be there is said.
std::optional<std::string> hidden_by_counts(const JointModel& joint, const Selected& selected) {
  constexpr double kPlainly = 1e-4;
  const auto is_an_alternative = [&](const ScoredCandidate& c) {
    return std::any_of(selected.alternatives.begin(), selected.alternatives.end(), [&](const auto& of_name) {
      return std::any_of(of_name.begin(), of_name.end(),
                         [&](const auto& a) { return a.effect->name == c.effect->name; });
    });
  };
  for (const ScoredCandidate& c : joint.accepted.empty() ? selected.first_look : selected.beside_all)
    if (!c.beyond_counts && c.p_value < kPlainly && !is_an_alternative(c))
      return name_in_words(*c.effect) + " would describe the recordings, but so little of it whole counts may feign";
  return std::nullopt;
}

}  // namespace

std::optional<Named> named(const JointModel& calibrated, const Predictor& predictor, double family_wise_error,
                           const Progress& progress, bool asks_what_is_undone) {
  constexpr double kSelected = 0.75;  // of the progress
  Named now{calibrated, {}, {}, {}, {}, {}, {}};
  JointModel& joint = now.joint;
  Selected& selected = now.selected;
  const auto go_on = [&](double) { return goes_on(progress, kSelected); };
  selected = select_effects(joint, family_wise_error, progress, {}, asks_what_is_undone);
  if (!goes_on(progress, kSelected)) return {};
  if (selected.undone) return now;
  // Where nothing was let in to stay, nothing that was tried may have moved the calibration and the noise.
  if (joint.accepted.empty()) joint = calibrated;
  const bool hinted = joint.accepted.empty() && !predictor.leaves_out_in_turn() &&
                      name_what_is_hinted_at(joint, selected, predictor, family_wise_error, go_on);
  if (!goes_on(progress, kSelected)) return {};
  take_simpler_forms(joint, selected, predictor.nominal());
  choose_by_unseen(predictor, joint, selected);
  now.intervals = refined(joint, inflations_of(selected));
  // What is not well away from nothing once its place and time are uncertain too is no finding, nor is what runs that
  // it was not fitted to refute.
  const auto untenable = [&]() -> std::optional<std::size_t> {
    constexpr double kByChance = 0.5;  // what was left of a name when another was taken out
    for (std::size_t k = joint.accepted.size(); k-- > 0;)
      if (selected.evidence[k].p_value > kByChance && !joint.accepted[k].is_held) return k;
    for (std::size_t k = joint.accepted.size(); k-- > 0;)
      if (!stands_out(joint, now.intervals, k)) return to_take_out(joint, selected, k);
    for (std::size_t k = joint.accepted.size(); k-- > 0;)
      if (!comes_back(joint, k, selected.evidence[k].test.inflation)) {
        now.warnings.push_back(
            name_in_words(*joint.accepted[k].effect) +
            " would describe the recordings together, but none is foretold by what the others say of it");
        return k;
      }
    for (std::size_t k = joint.accepted.size(); k-- > 0;)
      if (!joint.accepted[k].is_held && may_be_left_by_form(selected.evidence, k, family_wise_error)) {
        now.warnings.push_back(name_in_words(*joint.accepted[k].effect) +
                               " would describe a little of what is left, which may be the form of what was found");
        return k;
      }
    now.by_calibrated = predictor.of(calibrated, joint.model.noise);
    now.by_joint = joint.accepted.empty() ? now.by_calibrated : predictor.of(joint, joint.model.noise);
    if (const auto k = refuted(predictor, joint, now.by_joint, now.by_calibrated)) {
      now.warnings.push_back(
          name_in_words(*joint.accepted[*k].effect) +
          " would describe the recordings that were fitted, but what was not fitted is predicted worse with it");
      return k;
    }
    now.with_held_out = predictor.fitted_to_all(joint);
    if (!now.with_held_out) return std::nullopt;
    const auto k = not_borne_out(*now.with_held_out, selected, family_wise_error);
    if (k)
      now.warnings.push_back(name_in_words(*joint.accepted[*k].effect) +
                             " would describe the recordings that were fitted, but in all recordings, those held out "
                             "among them, it is no more than chance");
    return k;
  };
  constexpr std::size_t kMostUntenable = 2;
  std::vector<const Effect*> untenables;
  while (const std::optional<std::size_t> k = untenable()) {
    untenables.push_back(joint.accepted[*k].effect);
    const auto at = static_cast<std::ptrdiff_t>(*k);
    joint.accepted.erase(joint.accepted.begin() + at);
    selected.evidence.erase(selected.evidence.begin() + at);
    selected.alternatives.erase(selected.alternatives.begin() + at);
    selected.coming_back.erase(selected.coming_back.begin() + at);
    if (!joint.accepted.empty()) {
      joint.fit(3);
      joint.fit_noise_and_all();
      ask_again(joint, selected);
    } else {
      joint = calibrated;
      if (untenables.size() < kMostUntenable) {  // what it stood for may have another name
        selected = select_effects(joint, family_wise_error, go_on, untenables, asks_what_is_undone);
        if (!goes_on(progress, kSelected)) return {};
        if (selected.undone) return now;
        if (joint.accepted.empty()) joint = calibrated;
      }
    }
    now.intervals = refined(joint, inflations_of(selected));
  }
  if (const auto hidden = hidden_by_counts(joint, selected)) now.warnings.push_back(*hidden);
  if (hinted)
    for (const AcceptedEffect& a : joint.accepted)
      now.warnings.push_back("the recordings that were fitted only hint at " + name_in_words(*a.effect) +
                             "; those held out bear it out");
  return now;
}

}  // namespace odolab
