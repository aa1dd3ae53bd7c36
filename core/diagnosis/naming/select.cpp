#include "core/diagnosis/naming/select.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/naming/clocks_first.h"
#include "core/diagnosis/naming/compared_names.h"
#include "core/diagnosis/naming/lag_and_delay.h"
#include "core/diagnosis/naming/let_in.h"
#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/one_cause.h"
#include "core/diagnosis/naming/own_noise.h"
#include "core/diagnosis/naming/standing.h"

namespace odolab {

namespace {

constexpr int kMostEffects = 4;

// Of the shares that a name must have beside others (standing.cpp), where it is held against what could look like it
// (JointModel::can_look_like): a form that is wrong by a fourteenth, and everywhere in the way of the effect.
constexpr double kLeastShareWhereBothShow = 0.5;

// Of what a name says, what another must say at least that is asked of recordings held out, though it is beaten.
constexpr double kComparable = 0.5;

// One name after the other, then what each of them is worth beside the others.
class Selection {
 public:
  Selection(JointModel& joint, double family_wise_error, const std::vector<const Effect*>& refuted,
            bool asks_what_is_undone)
      : joint_(joint),
        family_wise_error_(family_wise_error),
        refuted_(refuted),
        asks_what_is_undone_(asks_what_is_undone) {}

  Selected run(const Progress& progress) {
    let_clocks_in(joint_);
    if (!joint_.accepted.empty()) clocks_ = joint_.accepted.front().effect;
    let_lag_in(joint_);
    double share = 0.3;
    for (int step = 0; step < kMostEffects; ++step) {
      if (!let_best_in()) break;
      if (out_.undone) return std::move(out_);
      align_held_clocks();
      find_places_again(joint_);
      find_moment_among_what_was_set_aside();
      if (!goes_on(progress, share += 0.08)) return std::move(out_);
      exchange_names();
    }
    put_lag_anew(joint_);
    if (asks_what_is_undone_ && with_all_.empty() && finds_what_is_undone()) return std::move(out_);
    drop_what_does_not_stand();
    out_.beside_all = std::move(with_all_);
    return std::move(out_);
  }

 private:
  using Standing = std::vector<const ScoredCandidate*>;  // best first

  bool is_refuted(const ScoredCandidate& c) const {
    return std::find(refuted_.begin(), refuted_.end(), c.effect) != refuted_.end();
  }

  bool is_taken(const ScoredCandidate& c) const {
    return std::any_of(joint_.accepted.begin(), joint_.accepted.end(),
                       [&](const AcceptedEffect& a) { return a.effect == c.effect; });
  }

  // Whether a candidate in the place of the k-th name would be said of a wheel twice.
  bool is_within_another(const ScoredCandidate& c, std::size_t k) const {
    for (std::size_t j = 0; j < joint_.accepted.size(); ++j) {
      const Effect& other = *joint_.accepted[j].effect;
      if (j != k && (is_within(*c.effect, other) || is_within(other, *c.effect))) return true;
    }
    return false;
  }

  double statistic_of(std::size_t k) const {
    const AcceptedEffect& a = joint_.accepted[k];
    return joint_.test(joint_.columns_of(*a.effect, a.shape), static_cast<int>(k)).statistic;
  }

  // What of the evidence of an accepted effect a form which is not quite the world's could make look like another
  // effect; `can`: as far as the two show in the same samples. What happens in one place or at one moment shares it
  // with few, and yet is the first that such a form leaves: it is held against all. So is what stands beside a truth
  // that is smoothed, of which kernels differ beyond their second moment.
  template <typename Can>
  double could_lend(std::size_t accepted, double says, const Effect& to, const Can& can) const {
    const double counts = counted(*joint_.accepted[accepted].effect, says);
    if (to.local || joint_.accepted[accepted].effect->of_the_truth || says <= 0.0) return counts;
    return std::min(1.0, kLeastShareWhereBothShow * can(static_cast<int>(accepted)) / says) * counts;
  }

  // Of the evidence an accepted effect's part.
  double share_of(std::size_t k, double at_least = 0.0) const {
    double others = 0.0;
    for (std::size_t j = 0; j < joint_.accepted.size(); ++j)
      if (j != k)
        others += could_lend(j, statistic_of(j), *joint_.accepted[k].effect,
                             [&](int other) { return joint_.can_look_like(static_cast<int>(k), other); });
    const double own = std::max(statistic_of(k), at_least);
    return own + others > 0.0 ? own / (own + others) : 1.0;
  }

  // Whether a candidate says more than what is let in, of which each `says` so much, could lend it.
  bool is_no_trace(const ScoredCandidate& c, const std::vector<double>& says, double distrust) const {
    if (joint_.accepted.empty()) return true;
    const CandidateColumns columns = joint_.columns_of(*c.effect, c.test.shape);
    double lent = 0.0;
    for (std::size_t k = 0; k < joint_.accepted.size(); ++k)
      lent += could_lend(k, says[k], *c.effect,
                         [&](int accepted) { return joint_.can_look_like(columns, c.test.value, accepted); });
    return c.test.statistic > lent * least_share(joint_, *c.effect, c.test, distrust);
  }

  Standing standing_of(const std::vector<ScoredCandidate>& scored) const {
    const double distrust = joint_.distrust();
    std::vector<double> says;  // under the noise as it is now, not as it was while these were missing
    for (std::size_t k = 0; k < joint_.accepted.size(); ++k) says.push_back(statistic_of(k));
    Standing standing;
    for (const ScoredCandidate& c : scored) {
      // Clocks that run apart by another rate in each recording are let in where they are beyond doubt, or not at all.
      const bool is_a_clock_of_each = c.effect->clock_rate && c.effect->of_each_recording;
      if (stands(c, family_wise_error_) && !is_refuted(c) && !of_the_same(joint_, c) && !is_a_clock_of_each &&
          is_no_trace(c, says, distrust))
        standing.push_back(&c);
    }
    std::stable_sort(standing.begin(), standing.end(),
                     [](const ScoredCandidate* a, const ScoredCandidate* b) { return a->p_value < b->p_value; });
    return standing;
  }

  // A candidate, the model with it and what that gained.
  struct Fitted {
    const ScoredCandidate* candidate;
    JointModel model;
    double gained;
  };

  Fitted fitted_with(const ScoredCandidate* c) const {
    Fitted f{c, joint_, 0.0};
    f.gained = let_in(f.model, *c);
    return is_at_its_bound(f.model.accepted.back()) ? fitted_in_other_forms(std::move(f)) : f;
  }

  // What is large leaves its physical bounds in one form and not in another.
  Fitted fitted_in_other_forms(Fitted at_bound) const {
    Fitted best = std::move(at_bound);
    for (std::size_t form = 0; form < best.candidate->effect->forms.size(); ++form) {
      if (static_cast<double>(form) == best.candidate->test.shape.back()) continue;
      ScoredCandidate other = *best.candidate;
      other.test.shape.back() = static_cast<double>(form);
      Fitted f{best.candidate, joint_, 0.0};
      f.gained = let_in(f.model, other);
      if (!is_at_its_bound(f.model.accepted.back()) &&
          (is_at_its_bound(best.model.accepted.back()) || f.gained > best.gained))
        best = std::move(f);
    }
    return best;
  }

  // Puts first what is simpler, or else what comes to more once it is fitted; what was fitted for it.
  std::vector<Fitted> put_best_first(Standing& standing) const {
    for (std::size_t k = 1; k < standing.size(); ++k)
      if (is_simpler(*standing[k], *standing[0])) {
        const auto simplest = standing.begin() + static_cast<std::ptrdiff_t>(k);
        std::rotate(standing.begin(), simplest, simplest + 1);
        return {};
      }
    // A score is what one step promises, and its scatter is that of what it does not explain yet: where another
    // promises more before that is allowed for, what both come to decides.
    const auto strongest = std::max_element(
        standing.begin(), standing.end(),
        [](const ScoredCandidate* a, const ScoredCandidate* b) { return a->test.statistic < b->test.statistic; });
    if (strongest == standing.end() || strongest == standing.begin() || of_one_moment(**strongest, *standing.front()))
      return {};
    std::vector<Fitted> fitted;
    for (const ScoredCandidate* c : {standing.front(), *strongest}) fitted.push_back(fitted_with(c));
    if (fitted[1].gained > fitted[0].gained + kClearlyBeaten + more_by_tries(**strongest, *standing.front()))
      std::rotate(standing.begin(), strongest, strongest + 1);
    return fitted;
  }

  // False where nothing stands.
  bool let_best_in() {
    constexpr std::size_t kMostTried = 3;
    constexpr double kLeastKept = 8.0;
    std::vector<ScoredCandidate> scored = scored_candidates(joint_);
    if (joint_.scalars() > kFewestToTellNoise) look_again(joint_, scored);
    Standing standing = standing_of(scored);
    if (out_.first_look.empty()) out_.first_look = scored;
    const std::vector<Fitted> fitted = put_best_first(standing);
    // The nonlinear fit must keep what the score promised, and dead reckoning must be the better for it; else the next.
    for (std::size_t tried = 0; tried < std::min(standing.size(), kMostTried); ++tried) {
      const auto known =
          std::find_if(fitted.begin(), fitted.end(), [&](const Fitted& f) { return f.candidate == standing[tried]; });
      Fitted with = known != fitted.end() ? *known : fitted_with(standing[tried]);
      with.model.fit_noise_and_all();
      double distrust = distrust_of(joint_, *standing[tried], family_wise_error_);
      // What whitens the innovations was what correlated them.
      if (distrust > 0.0 && with.model.distrust(standing[tried]->effect->local) == 0.0) distrust = 0.0;
      if (with.gained > kLeastKept && !is_at_its_bound(with.model.accepted.back()) &&
          (joint_.shows_at_rest(*standing[tried]->effect) ||
           is_material(distrust, joint_.truth_noise_lasts, joint_.gathered_error(), with.model.gathered_error(),
                       standing[tried]->test.value.size()))) {
        if (asks_what_is_undone_) out_.undone = undone(joint_, *standing[tried]);
        joint_ = std::move(with.model);
        return true;
      }
    }
    with_all_ = std::move(scored);
    return false;
  }

  // Where all names that may be let in are taken, moments that would still stand are asked whether they are undone:
  // not where so many of these stay that it is no mishap.
  bool finds_what_is_undone() {
    if (happened_once(joint_) >= kTimeAndAgain) return false;
    with_all_ = scored_candidates(joint_);
    for (const ScoredCandidate* c : standing_of(with_all_))
      if ((out_.undone = undone(joint_, *c))) return true;
    return false;
  }

  void align_held_clocks() {
    if (!joint_.clocks_are_held) return;
    align_clocks(joint_);
    joint_.fit(2);
  }

  // What happens at one moment contradicts the samples behind it, of which the first few were set aside: it was found
  // where these end.
  void find_moment_among_what_was_set_aside() {
    const AcceptedEffect& a = joint_.accepted.back();
    if (!a.effect->local || !a.effect->of_one_recording) return;
    joint_.readmit(static_cast<int>(a.shape[0]), a.shape[1]);
    joint_.fit(2);
    find_places_again(joint_);
    joint_.gate();
    joint_.fit(2);
  }

  // A name may have been the best only while another was missing.
  void exchange_names() {
    for (std::size_t k = 0; k + 1 < joint_.accepted.size(); ++k) {
      if (joint_.accepted[k].effect == clocks_) continue;
      const std::vector<ScoredCandidate> instead = scored_candidates(joint_, static_cast<int>(k));
      const auto own = std::find_if(instead.begin(), instead.end(),
                                    [&](const ScoredCandidate& c) { return c.effect == joint_.accepted[k].effect; });
      const ScoredCandidate& top = instead.front();
      if (own == instead.end() || is_taken(top) || is_refuted(top) || !stands(top, family_wise_error_) ||
          !beats(top, *own) || is_simpler(*own, top) || is_within_another(top, k))
        continue;
      joint_.accepted.erase(joint_.accepted.begin() + static_cast<std::ptrdiff_t>(k));
      let_in(joint_, top);
      joint_.fit_noise_and_all();
    }
  }

  // What was let in found its place and form since, and another may say more now that it has its own.
  bool puts_better_name(std::size_t k, const ScoredCandidate& own, const std::vector<ScoredCandidate>& instead) {
    const auto better = std::find_if(instead.begin(), instead.end(), [&](const ScoredCandidate& c) {
      return c.effect->name != own.effect->name && !is_simpler(own, c) && beats(c, own) && !is_taken(c) &&
             !is_refuted(c) && stands(c, family_wise_error_);
    });
    if (better == instead.end()) return false;
    joint_.accepted.erase(joint_.accepted.begin() + static_cast<std::ptrdiff_t>(k));
    let_in(joint_, *better);
    joint_.fit_noise_and_all();
    return true;
  }

  // Backward; what stands keeps what else could have been said in its place.
  void drop_what_does_not_stand() {
    for (std::size_t k = 0; k < joint_.accepted.size();)
      if (stays(k)) {
        ++k;
      } else {
        begin_again();
        k = 0;
      }
  }

  // Whether a name stays, with its evidence; else it is taken out of the model, or a better one is put in its place.
  bool stays(std::size_t k) {
    if (with_all_.empty()) with_all_ = scored_candidates(joint_);
    const std::vector<ScoredCandidate> instead = instead_of(k);
    ScoredCandidate own;
    for (const ScoredCandidate& c : instead)
      if (c.effect == joint_.accepted[k].effect) own = c;
    // Near where it stands a lag looks like a clock, and far from there it does not.
    const bool is_a_lag = own.effect && own.effect->shape_follows_amplitude;
    if (is_a_lag) {
      const double lost = joint_.lost_without(static_cast<int>(k));
      if (lost > own.test.statistic) {
        own.test.statistic = own.test.cross_validated = lost;
        own.test.shape = joint_.accepted[k].shape;
        own.beyond_counts = true;
        judge(own);
      }
    }
    if (own.effect && own.effect->local && exchanged_ < kMostEffects && puts_better_name(k, own, instead)) {
      ++exchanged_;
      return false;
    }
    const double least = least_share(joint_, *joint_.accepted[k].effect, own.test, joint_.distrust());
    const bool stands_here = own.effect && stands(own, family_wise_error_) && !is_at_its_bound(joint_.accepted[k]) &&
                             share_of(k, is_a_lag ? own.test.statistic : 0.0) >= least && keeps_its_place(k, own);
    if (!stands_here && !keep_needed(k, least, own)) return false;
    add_evidence(own, instead);
    return true;
  }

  void begin_again() {
    with_all_.clear();
    out_.evidence.clear();
    out_.alternatives.clear();
    out_.coming_back.clear();
  }

  // A patch whose rim a wheel but grazes is off the way once it is let in, and on it again once it is taken out: its
  // score then promises what no fit keeps.
  bool keeps_its_place(std::size_t k, const ScoredCandidate& own) const {
    constexpr double kKept = 0.2;
    if (!own.effect->local || own.effect->of_one_recording) return true;
    return joint_.lost_without(static_cast<int>(k)) > kKept * own.test.statistic;
  }

  std::vector<ScoredCandidate> instead_of(std::size_t k) const {
    std::vector<ScoredCandidate> instead;
    if (joint_.accepted[k].effect == clocks_)
      instead.push_back(tested_alone(joint_, k));
    else
      instead = scored_candidates(joint_, static_cast<int>(k));
    judge_locals_by(with_all_, instead);
    return instead;
  }

  // What the test does not hold up may still be what the fit cannot do without; else it is taken out of the model.
  bool keep_needed(std::size_t k, double least, ScoredCandidate& own) {
    constexpr double kNeeded = 100.0;  // of twice the log-likelihood
    const AcceptedEffect& a = joint_.accepted[k];
    JointModel without = joint_;
    const double lost = joint_.lost_without(static_cast<int>(k), &without);
    without.fit_noise_and_all();
    if (lost <= kNeeded || is_at_its_bound(a) || share_of(k, a.is_held ? lost : 0.0) <= least ||
        !lowers(without.gathered_error(), joint_.gathered_error(), kMaterial)) {
      joint_ = without;
      return false;
    }
    own.effect = a.effect;
    own.test.shape = a.shape;
    own.test.statistic = lost;
    own.test.inflation = std::max(1.0, own.test.inflation);
    own.p_value = chi_square_tail(lost / own.test.inflation, static_cast<int>(a.value.size()));
    return true;
  }

  void add_evidence(const ScoredCandidate& own, const std::vector<ScoredCandidate>& instead) {
    std::vector<ScoredCandidate> alternatives, coming_back;
    for (const ScoredCandidate& c : instead) {
      if (is_taken(c) || is_refuted(c) || c.p_value > family_wise_error_ || c.effect->name == own.effect->name ||
          says_as_much_beside(c, with_all_))
        continue;
      // What whole counts may feign is no name; but nor is another alone of which it says more.
      if (!c.beyond_counts && c.test.statistic / own.test.inflation < own.test.judged()) continue;
      const bool at_one_place = of_one_moment(own, c) || of_one_small_place(own, c) || of_one_small_place(c, own);
      const double beaten_by =
          std::max(kClearlyBeaten + more_by_tries(own, c), at_one_place ? kFormError * own.test.judged() : 0.0);
      if (own.test.judged() - c.test.statistic / own.test.inflation < beaten_by)
        alternatives.push_back(c);
      else if (own.effect->of_one_recording && !c.effect->of_one_recording && stands(c, family_wise_error_) &&
               c.test.judged() > kComparable * own.test.judged())
        coming_back.push_back(c);
    }
    out_.evidence.push_back(own);
    out_.alternatives.push_back(alternatives);
    out_.coming_back.push_back(coming_back);
  }

  JointModel& joint_;
  double family_wise_error_;
  const std::vector<const Effect*>& refuted_;
  bool asks_what_is_undone_;
  const Effect* clocks_ = nullptr;         // known beyond doubt
  int exchanged_ = 0;                      // names, for better ones
  std::vector<ScoredCandidate> with_all_;  // judged against the model that has all that was let in
  Selected out_;
};

}  // namespace

Selected select_effects(JointModel& joint, double family_wise_error, const Progress& progress,
                        const std::vector<const Effect*>& refuted, bool asks_what_is_undone) {
  return Selection(joint, family_wise_error, refuted, asks_what_is_undone).run(progress);
}

}  // namespace odolab
