#include "core/diagnosis/named.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/formatted.h"
#include "core/diagnosis/borne_out.h"
#include "core/diagnosis/chosen_by_unseen.h"
#include "core/diagnosis/naming/in_each_run.h"
#include "core/diagnosis/naming/left_by_form.h"
#include "core/diagnosis/refuted.h"
#include "core/diagnosis/simpler_forms.h"

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

// Names are let in, and of these those are taken out again that do not hold.
class Naming {
 public:
  Naming(const JointModel& calibrated, const Predictor& predictor, double family_wise_error, const Progress& progress,
         bool asks_what_is_undone)
      : calibrated_(calibrated),
        predictor_(predictor),
        family_wise_error_(family_wise_error),
        progress_(progress),
        asks_what_is_undone_(asks_what_is_undone),
        now_{calibrated, {}, {}, {}, {}, {}, {}, {}} {}

  std::optional<Named> run() {
    if (!let_in(progress_)) return {};
    if (selected_.undone) return std::move(now_);
    const bool hinted = joint_.accepted.empty() && !predictor_.leaves_out_in_turn() &&
                        name_what_is_hinted_at(joint_, selected_, predictor_, family_wise_error_, go_on_);
    if (!goes_on(progress_, kSelected)) return {};
    take_simpler_forms(joint_, selected_, predictor_.nominal());
    choose_by_unseen(predictor_, joint_, selected_);
    now_.intervals = refined(joint_, inflations_of(selected_));
    while (const std::optional<std::size_t> k = untenable()) {
      take_out(*k);
      if (!joint_.accepted.empty()) {
        joint_.fit(3);
        joint_.fit_noise_and_all();
        ask_again(joint_, selected_);
      } else {
        joint_ = calibrated_;
        // What it stood for may have another name.
        if (untenables_.size() < kMostUntenable && !let_in(go_on_)) return {};
        if (selected_.undone) return std::move(now_);
      }
      now_.intervals = refined(joint_, inflations_of(selected_));
    }
    if (const auto hidden = hidden_by_counts(joint_, selected_)) now_.warnings.push_back(*hidden);
    if (hinted)
      for (const AcceptedEffect& a : joint_.accepted)
        now_.warnings.push_back("the recordings that were fitted only hint at " + name_in_words(*a.effect) +
                                "; those held out bear it out");
    return std::move(now_);
  }

 private:
  static constexpr double kSelected = 0.75;  // of the progress
  static constexpr std::size_t kMostUntenable = 2;

  // All but what was untenable; false where it was stopped. Where nothing was let in to stay, nothing that was tried
  // may have moved the calibration and the noise.
  bool let_in(const Progress& progress) {
    selected_ = select_effects(joint_, family_wise_error_, progress, untenables_, asks_what_is_undone_);
    if (!goes_on(progress_, kSelected)) return false;
    if (joint_.accepted.empty() && !selected_.undone) joint_ = calibrated_;
    return true;
  }

  void take_out(std::size_t k) {
    untenables_.push_back(joint_.accepted[k].effect);
    const auto at = static_cast<std::ptrdiff_t>(k);
    joint_.accepted.erase(joint_.accepted.begin() + at);
    selected_.evidence.erase(selected_.evidence.begin() + at);
    selected_.alternatives.erase(selected_.alternatives.begin() + at);
    selected_.coming_back.erase(selected_.coming_back.begin() + at);
  }

  // What is not well away from nothing once its place and time are uncertain too is no finding, nor is what runs that
  // it was not fitted to refute.
  std::optional<std::size_t> untenable() {
    if (const auto k = untenable_by_itself()) return k;
    now_.by_calibrated = predictor_.of(calibrated_, joint_.model.noise);
    now_.by_joint = joint_.accepted.empty() ? now_.by_calibrated : predictor_.of(joint_, joint_.model.noise);
    if (const auto k = refuted(predictor_, joint_, now_.by_joint, now_.by_calibrated)) {
      warn(*k, "would describe the recordings that were fitted, but what was not fitted is predicted worse with it");
      return k;
    }
    now_.with_held_out = predictor_.fitted_to_all(joint_);
    if (!now_.with_held_out) return std::nullopt;
    const auto k = not_borne_out(*now_.with_held_out, selected_, family_wise_error_);
    if (k)
      warn(*k,
           "would describe the recordings that were fitted, but in all recordings, those held out among them, it is no "
           "more than chance");
    return k;
  }

  // Of the recordings that it was fitted to.
  std::optional<std::size_t> untenable_by_itself() {
    constexpr double kByChance = 0.5;  // what was left of a name when another was taken out
    for (std::size_t k = joint_.accepted.size(); k-- > 0;)
      if (selected_.evidence[k].p_value > kByChance && !joint_.accepted[k].is_held) return k;
    for (std::size_t k = joint_.accepted.size(); k-- > 0;)
      if (const auto older_s = older_instead(joint_, k, selected_.evidence[k])) {
        now_.older_counts.right_older_s = *older_s;
        now_.older_counts.instead_of.push_back(name_in_words(*joint_.accepted[k].effect));
        return k;
      }
    for (std::size_t k = joint_.accepted.size(); k-- > 0;)
      if (!stands_out(joint_, now_.intervals, k)) return to_take_out(joint_, selected_, k);
    if (is_one_place_by_chance()) {
      warn(0, "would describe a little of what is left, but somewhere noise does so now and then");
      return 0;
    }
    for (std::size_t k = joint_.accepted.size(); k-- > 0;)
      if (!comes_back(joint_, k, selected_.evidence[k].test.inflation)) {
        warn(k, "would describe the recordings together, but none is foretold by what the others say of it");
        return k;
      }
    for (std::size_t k = joint_.accepted.size(); k-- > 0;)
      if (!joint_.accepted[k].is_held && may_be_left_by_form(selected_.evidence, k, family_wise_error_)) {
        warn(k, "would describe a little of what is left, which may be the form of what was found");
        return k;
      }
    return std::nullopt;
  }

  // The one name, of a place or a moment. It is sought in thousands, and so far out noise is larger than as a rule: of
  // ten such names of twenty seeds of six programs eight were wrong, six of them where nothing was missing.
  bool is_one_place_by_chance() const {
    constexpr double kAlone = 0.025;  // of the family-wise error
    return joint_.accepted.size() == 1 && joint_.accepted[0].effect->local &&
           selected_.evidence[0].p_value > kAlone * family_wise_error_;
  }

  void warn(std::size_t k, const char* of_it) {
    now_.warnings.push_back(name_in_words(*joint_.accepted[k].effect) + " " + of_it);
  }

  const JointModel& calibrated_;
  const Predictor& predictor_;
  double family_wise_error_;
  const Progress& progress_;
  const Progress go_on_ = [this](double) { return goes_on(progress_, kSelected); };
  bool asks_what_is_undone_;
  Named now_;
  JointModel& joint_ = now_.joint;
  Selected& selected_ = now_.selected;
  std::vector<const Effect*> untenables_;
};

}  // namespace

std::optional<Named> named(const JointModel& calibrated, const Predictor& predictor, double family_wise_error,
                           const Progress& progress, bool asks_what_is_undone) {
  return Naming(calibrated, predictor, family_wise_error, progress, asks_what_is_undone).run();
}

}  // namespace odolab
