#include "core/diagnosis/naming/select.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/naming/clocks_first.h"
#include "core/diagnosis/naming/lag_and_delay.h"
#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/own_noise.h"

namespace odolab {

namespace {

constexpr int kMostEffects = 4;
// A form is never quite that of the world: what is left of a strong effect is not another one, the less so one that
// looks like it.
constexpr double kLeastShare = 0.01, kLeastShareOfEvents = 0.03, kLeastShareBesideItsLike = 0.05;

// Share of the evidence that a right name may lose since its form is not quite the world's.
constexpr double kFormError = 0.15;
// Of what a name says, what another must say at least that is asked of recordings held out, though it is beaten.
constexpr double kComparable = 0.5;

bool looks_like(const Effect& a, const Effect& b) {
  const auto names = [](const Effect& one, const Effect& other) {
    return std::find(one.looks_like.begin(), one.looks_like.end(), other.name) != one.looks_like.end();
  };
  return a.name != b.name && (names(a, b) || names(b, a));
}

Motions motion_of(const Effect& effect, const DriveView& view, const std::vector<double>& shape,
                  const std::vector<double>& value) {
  Motions sum(view.steps.size());
  const std::vector<Motions> columns = effect.motions(view, shape);
  for (std::size_t k = 0; k < columns.size() && k < value.size(); ++k) columns[k].add_to(sum, value[k]);
  return sum;
}

// Whether another effect that acts but here and there acts where this one does, and half as strongly: no castor kicks
// twice alike.
bool happens_within_another(const JointModel& joint, const Effect& event, const CandidateTest& test) {
  constexpr double kSeldom = 0.4, kAsStrongly = 0.5;
  const auto size_m = [](const BodyMotion& m, double base_m) {
    return std::abs(m.forward_m) + std::abs(m.sideways_m) + 0.5 * base_m * std::abs(m.turn_rad);
  };
  return std::any_of(joint.accepted.begin(), joint.accepted.end(), [&](const AcceptedEffect& a) {
    if (a.effect == &event || !a.acts_on_motion()) return false;
    double own_m = 0.0, other_m = 0.0, acts = 0.0, steps = 0.0;
    for (const DriveView& view : joint.views()) {
      const Motions own = motion_of(event, view, test.shape, test.value);
      const Motions other = motion_of(*a.effect, view, a.shape, a.value);
      for (std::size_t i = 0; i < view.steps.size(); ++i) {
        const double of_own = size_m(own.at(i), view.drive.wheelbase_m),
                     of_other = size_m(other.at(i), view.drive.wheelbase_m);
        own_m += of_own, other_m += of_own > 0.0 ? of_other : 0.0;
        acts += of_other > 0.0 ? 1.0 : 0.0, steps += 1.0;
      }
    }
    return acts < kSeldom * steps && other_m > kAsStrongly * own_m;
  });
}

// Of all the evidence, that an effect must have beside those that are let in. Where innovations are correlated a small
// share is believed as little as an event's.
double least_share(const JointModel& joint, const Effect& effect, const CandidateTest& test, double distrust) {
  if (effect.local && !test.value.empty() && happens_within_another(joint, effect, test)) return kFormError;
  if (std::any_of(joint.accepted.begin(), joint.accepted.end(),
                  [&](const AcceptedEffect& a) { return looks_like(*a.effect, effect); }))
    return kLeastShareBesideItsLike;
  return effect.local ? kLeastShareOfEvents : std::lerp(kLeastShare, kLeastShareOfEvents, distrust);
}

// An accepted effect as it stands, held against nothing else.
ScoredCandidate tested_alone(const JointModel& joint, std::size_t accepted) {
  const AcceptedEffect& a = joint.accepted[accepted];
  ScoredCandidate c;
  c.effect = a.effect;
  c.test = joint.test(joint.columns_of(*a.effect, a.shape), static_cast<int>(accepted), true);
  c.test.shape = a.shape;
  judge(c);
  return c;
}

// What happens in one place or at one moment is judged by how large it seems in all others. While it is left out of the
// model it shows in all that comes behind it, the more so the smaller the noise is: others' scatter is then taken from
// the model that has it.
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

// How little the likelihood is to be believed of a candidate: not at all less where it would stand though all were the
// more uncertain for the correlation, by a factor without bounds where that is plain.
double distrust_of(const JointModel& joint, const ScoredCandidate& c, double family_wise_error) {
  constexpr double kPerOdds = 2.0;
  const double distrust = joint.distrust(c.effect->local);
  if (distrust == 0.0 || distrust >= 1.0) return distrust;
  ScoredCandidate doubted = c;
  doubted.test.inflation *= 1.0 + kPerOdds * distrust / (1.0 - distrust);
  judge(doubted);
  return doubted.p_value < family_wise_error ? 0.0 : distrust;
}

bool of_one_moment(const ScoredCandidate& a, const ScoredCandidate& b) {
  return a.effect->of_one_recording && b.effect->of_one_recording && a.test.shape[0] == b.test.shape[0] &&
         std::abs(a.test.shape[1] - b.test.shape[1]) < 0.5;
}

// Whether a candidate in a name's place says beside the name as much: then it is something else, and no other name for
// it.
bool says_as_much_beside(const ScoredCandidate& instead, const std::vector<ScoredCandidate>& with_all) {
  constexpr double kAsMuch = 0.8;
  return std::any_of(with_all.begin(), with_all.end(), [&](const ScoredCandidate& c) {
    return c.effect == instead.effect && c.test.statistic > kAsMuch * instead.test.statistic &&
           (!c.effect->of_one_recording || of_one_moment(c, instead));
  });
}

constexpr double kWidestBump_m = 0.2;

// A bump that is met each time, and a patch about it that is no wider than a bump may be.
bool of_one_small_place(const ScoredCandidate& bump, const ScoredCandidate& patch) {
  if (bump.effect->name != "bump" || bump.effect->of_one_recording || patch.effect->name != "slip_zone") return false;
  const Vec2 apart{bump.test.shape[0] - patch.test.shape[0], bump.test.shape[1] - patch.test.shape[1]};
  return patch.test.shape[2] < kWidestBump_m && length(apart) < kWidestBump_m;
}

// Whether the vehicle is on a patch about a moment.
bool happens_on(const JointModel& joint, const std::vector<double>& moment, const std::vector<double>& patch) {
  constexpr double kAbout_s = 0.5;
  const DriveView& view = joint.views()[static_cast<std::size_t>(moment[0])];
  return std::any_of(view.steps.begin(), view.steps.end(), [&](const EffectStep& s) {
    return std::abs(s.time_s - moment[1]) < kAbout_s &&
           length(s.position - Vec2{patch[0], patch[1]}) < patch[2] + view.drive.wheelbase_m;
  });
}

// What is left of something that was already let in belongs to its shape.
bool of_the_same(const JointModel& joint, const ScoredCandidate& c) {
  for (const AcceptedEffect& a : joint.accepted)
    if (!is_finer(*c.effect, *a.effect) && !a.effect->local && a.effect->name == c.effect->name &&
        a.effect->component == c.effect->component)
      return true;
  if (!c.effect->local) return false;
  for (const AcceptedEffect& a : joint.accepted) {
    if (a.effect->name == "slip_zone") {
      if (!c.effect->of_one_recording) return true;  // one patch at a time: a disc is only nearly its shape
      if (happens_on(joint, c.test.shape, a.shape)) return true;
    }
    if (c.effect->name == "slip_zone" && a.effect->local && a.effect->of_one_recording &&
        happens_on(joint, a.shape, c.test.shape))
      return true;
    // A bump that is met now and then by its edge is met less, or more, at some moment.
    if (c.effect->of_one_recording && a.effect->name == "bump" && !a.effect->of_one_recording &&
        happens_on(joint, c.test.shape, {a.shape[0], a.shape[1], kWidestBump_m}))
      return true;
    if (c.effect->of_one_recording && a.effect->local && a.effect->of_one_recording && a.shape[0] == c.test.shape[0] &&
        std::abs(a.shape[1] - c.test.shape[1]) < 1.0)
      return true;
  }
  return false;
}

// Twice what the log-likelihood gains by it under the noise as it is.
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
  if (c.effect->only_commands) put_lag_where_likeliest(joint);
  return gained;
}

// Innovations that tell their noise from what one name takes away: poses at both ends of ten runs do not.
constexpr double kFewestForTheirNoise = 100.0;

// Where nothing stands, what comes nearest is asked once more under the noise that it leaves. One moment moves no
// noise.
void look_again(const JointModel& joint, std::vector<ScoredCandidate>& scored) {
  constexpr std::size_t kMost = 2;
  constexpr double kWorthALook =
      8.0;  // of the statistic; and it must then be larger by more than noise loses to any term
  constexpr double kLarger = 1.25;
  std::vector<ScoredCandidate*> nearest;
  for (ScoredCandidate& c : scored)
    if (!c.effect->of_one_recording && c.beyond_counts && c.test.judged() > kWorthALook && !of_the_same(joint, c))
      nearest.push_back(&c);
  const auto tail = [](const ScoredCandidate* c) {
    return std::log(std::max(chi_square_tail(c->test.judged(), c->test.freedom), 1e-300)) + c->log_tests;
  };
  std::stable_sort(nearest.begin(), nearest.end(), [&](const auto* a, const auto* b) { return tail(a) < tail(b); });
  if (nearest.size() > kMost) nearest.resize(kMost);
  parallel_for(static_cast<int>(nearest.size()), [&](int i) {
    ScoredCandidate& c = *nearest[static_cast<std::size_t>(i)];
    JointModel with = joint;
    let_in(with, c);
    const CandidateTest again = tested_under_own_noise(joint, with, !c.effect->local);
    if (again.statistic < kLarger * c.test.statistic) return;
    c.test.statistic = again.statistic;
    if (!c.effect->local) c.test.inflation = again.inflation, c.test.cross_validated = again.cross_validated;
    judge(c);
  });
}

// A push of three numbers fits whatever a bump of one does, and its form is exact: where one number says nearly as much
// it is the better name. So it is beside a patch, whose place and size were looked for in three directions.
bool is_simpler(const ScoredCandidate& c, const ScoredCandidate& other) {
  if (c.test.judged() < (1.0 - kFormError) * other.test.judged()) return false;
  if (of_one_moment(c, other) || other.effect->name == "collision") return c.test.freedom < other.test.freedom;
  return of_one_small_place(c, other) ||
         (c.effect->name == "bump" && c.effect->of_one_recording && other.effect->name == "slip_zone");
}

}  // namespace

Selected select_effects(JointModel& joint, double family_wise_error, const Progress& progress,
                        const std::vector<const Effect*>& refuted) {
  const auto is_refuted = [&](const ScoredCandidate& c) {
    return std::find(refuted.begin(), refuted.end(), c.effect) != refuted.end();
  };
  // Clocks that run apart by another rate in each recording are let in where they are beyond doubt, or not at all.
  const auto is_a_clock_of_each = [](const ScoredCandidate& c) {
    return c.effect->clock_rate && c.effect->of_each_recording;
  };
  Selected out;
  std::vector<ScoredCandidate> with_all;  // judged against the model that has all that was let in
  double share = 0.3;
  let_clocks_in(joint);
  const Effect* clocks = joint.accepted.empty() ? nullptr : joint.accepted.front().effect;  // known beyond doubt
  for (int step = 0; step < kMostEffects; ++step) {
    double explained = 0.0;  // under the noise as it is now, not as it was while these were missing
    for (std::size_t k = 0; k < joint.accepted.size(); ++k)
      explained += joint.test(joint.columns_of(*joint.accepted[k].effect, joint.accepted[k].shape), static_cast<int>(k))
                       .statistic;
    std::vector<ScoredCandidate> scored = scored_candidates(joint);
    const double distrust = joint.distrust();
    std::vector<const ScoredCandidate*> standing;
    const auto find_standing = [&] {
      for (const ScoredCandidate& c : scored)
        if (stands(c, family_wise_error) && !is_refuted(c) && !of_the_same(joint, c) && !is_a_clock_of_each(c) &&
            c.test.statistic > explained * least_share(joint, *c.effect, c.test, distrust))
          standing.push_back(&c);
    };
    find_standing();
    if (standing.empty() && joint.scalars() > kFewestForTheirNoise) {
      look_again(joint, scored);
      find_standing();
    }
    if (step == 0) out.first_look = scored;
    std::stable_sort(standing.begin(), standing.end(),
                     [](const ScoredCandidate* a, const ScoredCandidate* b) { return a->p_value < b->p_value; });
    bool is_simplest = false;
    for (std::size_t k = 1; k < standing.size() && !is_simplest; ++k)
      if (is_simpler(*standing[k], *standing[0])) {
        std::rotate(standing.begin(), standing.begin() + static_cast<std::ptrdiff_t>(k),
                    standing.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        is_simplest = true;
      }
    const JointModel before = joint;
    struct Fitted {
      const ScoredCandidate* candidate;
      JointModel model;
      double gained;
    };
    std::vector<Fitted> fitted;
    // A score is what one step promises, and its scatter is that of what it does not explain yet: where another
    // promises more before that is allowed for, what both come to decides.
    const auto strongest = std::max_element(
        standing.begin(), standing.end(),
        [](const ScoredCandidate* a, const ScoredCandidate* b) { return a->test.statistic < b->test.statistic; });
    if (strongest != standing.end() && strongest != standing.begin() && !is_simplest &&
        !of_one_moment(**strongest, *standing.front())) {
      for (const ScoredCandidate* c : {standing.front(), *strongest}) {
        fitted.push_back({c, joint, 0.0});
        fitted.back().gained = let_in(fitted.back().model, *c);
      }
      if (fitted[1].gained > fitted[0].gained + 2.0 * kClearlyBeaten)
        std::rotate(standing.begin(), strongest, strongest + 1);
    }
    bool accepted = false;
    // The nonlinear fit must keep what the score promised, and dead reckoning must be the better for it; else the next.
    for (std::size_t tried = 0; tried < std::min<std::size_t>(standing.size(), 3) && !accepted; ++tried) {
      const auto known =
          std::find_if(fitted.begin(), fitted.end(), [&](const Fitted& f) { return f.candidate == standing[tried]; });
      if (known != fitted.end()) joint = known->model;
      const double kept = known != fitted.end() ? known->gained : let_in(joint, *standing[tried]);
      joint.fit_noise_and_all();
      accepted = kept > 8.0 &&
                 is_material(distrust_of(before, *standing[tried], family_wise_error), before.truth_noise_lasts,
                             before.gathered_error(), joint.gathered_error(), standing[tried]->test.value.size());
      if (!accepted) joint = before;
    }
    if (!accepted) {
      with_all = std::move(scored);
      break;
    }
    if (joint.clocks_are_held) {
      align_clocks(joint);
      joint.fit(2);
    }
    // Its place and time were found under the noise that it made itself.
    for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
      AcceptedEffect& a = joint.accepted[k];
      if (!a.effect->scan || a.effect->shape_follows_amplitude) continue;
      const double now = joint.test(joint.columns_of(*a.effect, a.shape), static_cast<int>(k)).statistic;
      const ScoredCandidate again =
          scored_candidate(joint, CandidateScan(joint, static_cast<int>(k)), *a.effect, static_cast<int>(k), 1);
      if (again.test.statistic < now + 1.0) continue;
      a.shape = again.test.shape;
      a.value = again.test.value;
      joint.fit(2);
      joint.fit_noise_and_all();
    }
    if (!goes_on(progress, share += 0.08)) return out;
    // A name may have been the best only while another was missing.
    if (joint.accepted.size() > 1)
      for (std::size_t k = 0; k + 1 < joint.accepted.size(); ++k) {
        if (joint.accepted[k].effect == clocks) continue;
        const std::vector<ScoredCandidate> instead = scored_candidates(joint, static_cast<int>(k));
        const ScoredCandidate* own = nullptr;
        for (const ScoredCandidate& c : instead)
          if (c.effect == joint.accepted[k].effect) own = &c;
        const ScoredCandidate& top = instead.front();
        const bool taken = std::any_of(joint.accepted.begin(), joint.accepted.end(),
                                       [&](const AcceptedEffect& a) { return a.effect == top.effect; });
        if (own && !taken && !is_refuted(top) && stands(top, family_wise_error) &&
            top.test.judged() > own->test.judged() + 2.0 * kClearlyBeaten && !is_simpler(*own, top)) {
          joint.accepted.erase(joint.accepted.begin() + static_cast<std::ptrdiff_t>(k));
          let_in(joint, top);
          joint.fit_noise_and_all();
        }
      }
  }
  // Backward, and what else could have been said in the place of each.
  const auto share_of = [&](std::size_t k, double at_least = 0.0) {
    double others = 0.0, own = 0.0;
    for (std::size_t j = 0; j < joint.accepted.size(); ++j) {
      const double t =
          joint.test(joint.columns_of(*joint.accepted[j].effect, joint.accepted[j].shape), static_cast<int>(j))
              .statistic;
      (j == k ? own : others) += t;
    }
    own = std::max(own, at_least);
    return own + others > 0.0 ? own / (own + others) : 1.0;
  };
  for (std::size_t k = 0; k < joint.accepted.size();) {
    if (with_all.empty()) with_all = scored_candidates(joint);
    std::vector<ScoredCandidate> instead;
    if (joint.accepted[k].effect == clocks)
      instead.push_back(tested_alone(joint, k));
    else
      instead = scored_candidates(joint, static_cast<int>(k));
    judge_locals_by(with_all, instead);
    ScoredCandidate own;
    for (const ScoredCandidate& c : instead)
      if (c.effect == joint.accepted[k].effect) own = c;
    const double least = least_share(joint, *joint.accepted[k].effect, own.test, joint.distrust());
    if (!own.effect || !stands(own, family_wise_error) || share_of(k) < least) {
      JointModel without = joint;
      const double lost = joint.lost_without(static_cast<int>(k), &without);
      without.fit_noise_and_all();
      const bool needed = lost > 100.0 && share_of(k, joint.accepted[k].is_held ? lost : 0.0) > least &&
                          lowers(without.gathered_error(), joint.gathered_error(), kMaterial);
      if (!needed) {
        joint = without;
        with_all.clear();
        out.evidence.clear();
        out.alternatives.clear();
        out.coming_back.clear();
        k = 0;
        continue;
      }
      own.effect = joint.accepted[k].effect;
      own.test.shape = joint.accepted[k].shape;
      own.test.statistic = lost;
      own.test.inflation = std::max(1.0, own.test.inflation);
      own.p_value = chi_square_tail(lost / own.test.inflation, static_cast<int>(joint.accepted[k].value.size()));
    }
    std::vector<ScoredCandidate> alternatives, coming_back;
    for (const ScoredCandidate& c : instead) {
      const bool taken = std::any_of(joint.accepted.begin(), joint.accepted.end(),
                                     [&](const AcceptedEffect& a) { return a.effect == c.effect; });
      if (taken || is_refuted(c) || c.p_value > family_wise_error || !c.beyond_counts ||
          c.effect->name == own.effect->name || says_as_much_beside(c, with_all))
        continue;
      const bool at_one_place = of_one_moment(own, c) || of_one_small_place(own, c) || of_one_small_place(c, own);
      // What was looked for in more places and at more times must say so much more.
      const double by_tries = 2.0 * std::max(0.0, own.log_tests - c.log_tests);
      const double beaten_by =
          std::max(2.0 * kClearlyBeaten + by_tries, at_one_place ? kFormError * own.test.judged() : 0.0);
      if (own.test.judged() - c.test.statistic / own.test.inflation < beaten_by)
        alternatives.push_back(c);
      else if (own.effect->of_one_recording && !c.effect->of_one_recording && stands(c, family_wise_error) &&
               c.test.judged() > kComparable * own.test.judged())
        coming_back.push_back(c);
    }
    out.evidence.push_back(own);
    out.alternatives.push_back(alternatives);
    out.coming_back.push_back(coming_back);
    ++k;
  }
  return out;
}

}  // namespace odolab
