#include "core/diagnosis/select.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/candidate_scan.h"
#include "core/diagnosis/chi_square.h"
#include "core/diagnosis/clocks_first.h"
#include "core/diagnosis/material.h"

namespace odolab {

namespace {

constexpr int kMostEffects = 4;
// A form is never quite that of the world: what is left of a strong effect is not another one.
constexpr double kLeastShare = 0.01, kLeastShareOfEvents = 0.03;

// Share of the evidence that a right name may lose since its form is not quite the world's.
constexpr double kFormError = 0.1;

// Where innovations are correlated a small share is believed as little as an event's.
double least_share(const Effect& effect, double distrust) {
  return effect.local ? kLeastShareOfEvents : std::lerp(kLeastShare, kLeastShareOfEvents, distrust);
}

double quantile(std::vector<double> v, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), v.begin() + k, v.end());
  return v[static_cast<std::size_t>(k)];
}

// Median and 90 % quantile of chi-square for freedom 1 to 3.
constexpr double kMedian[4] = {0.0, 0.455, 1.386, 2.366}, kNinety[4] = {0.0, 2.706, 4.605, 6.251};

bool physical(const Effect& e, const std::vector<double>& value) {
  for (std::size_t k = 0; k < value.size(); ++k)
    if (value[k] < e.amplitudes[k].low || value[k] > e.amplitudes[k].high) return false;
  return true;
}

std::vector<std::vector<double>> shapes_near(const Effect& e, const std::vector<double>& shape, double scale) {
  std::vector<std::vector<double>> near;
  for (std::size_t k = 0; k < e.shapes.size(); ++k)
    for (double side : {-1.0, 1.0}) {
      if (!is_estimated(e.shapes[k])) continue;
      std::vector<double> s = shape;
      const std::string& unit = e.shapes[k].unit;
      if (unit == "s" && !e.shape_follows_amplitude)
        s[k] += side * scale * (e.local ? 0.1 : 3.0);
      else if (e.shapes[k].name == "radius_m")
        s[k] *= 1.0 + side * 0.25 * scale;
      else if (unit == "m")
        s[k] += side * scale * 0.2;
      else
        s[k] *= 1.0 + side * 0.15 * scale;
      near.push_back(s);
    }
  // A place is not found along the axes alone.
  for (std::size_t k = 0; k + 1 < e.shapes.size(); ++k)
    if (e.shapes[k].name == "x_m" && e.shapes[k + 1].name == "y_m")
      for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {-1.0, 1.0}, {1.0, -1.0}, {1.0, 1.0}}) {
        std::vector<double> s = shape;
        s[k] += x * scale * 0.15;
        s[k + 1] += y * scale * 0.15;
        near.push_back(s);
      }
  return near;
}

bool near_a_rest(const InnovationRun& run, double time_s) {
  constexpr double kNear_s = 0.5;
  for (std::size_t i = 0; i < run.settles.size(); ++i)
    if (run.settles[i] && std::abs(0.5 * (run.wheels[i].time_s + run.wheels[i + 1].time_s) - time_s) < kNear_s)
      return true;
  return false;
}

// How far a wheel, or the vehicle sideways, is carried in one go at most.
double furthest_m(const std::vector<Motions>& motions, const std::vector<double>& value, double wheelbase_m) {
  std::size_t first = static_cast<std::size_t>(-1), end = 0;
  for (const Motions& m : motions)
    if (!m.empty()) first = std::min(first, m.first()), end = std::max(end, m.end());
  double furthest = 0.0;
  BodyMotion carried;
  for (std::size_t i = first; i < end; ++i) {
    BodyMotion by;
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const BodyMotion m = motions[k].at(i);
      by.forward_m += value[k] * m.forward_m;
      by.sideways_m += value[k] * m.sideways_m;
      by.turn_rad += value[k] * m.turn_rad;
    }
    if (by.forward_m == 0.0 && by.sideways_m == 0.0 && by.turn_rad == 0.0) carried = {};
    carried.forward_m += by.forward_m;
    carried.sideways_m += by.sideways_m;
    carried.turn_rad += by.turn_rad;
    furthest = std::max({furthest, std::abs(carried.sideways_m),
                         std::abs(carried.forward_m) + 0.5 * wheelbase_m * std::abs(carried.turn_rad)});
  }
  return furthest;
}

// A wheel's count is off by what is hidden between two of them: that averages out on the way, but not at an even speed
// that is nearly a whole number of counts from one reading to the next; and it stays where the wheel stops.
bool beyond_counts(const JointModel& joint, const Effect& e, const CandidateTest& test) {
  constexpr double kCounts = 1.5, kCountsAtRest = 2.0;
  const DifferentialDrive& drive = joint.model.drive;
  const double radius_m = std::max(drive.wheel_radius_left_m, drive.wheel_radius_right_m);
  double furthest = 0.0, least = 0.0;
  for (std::size_t r = 0; r < joint.runs().size(); ++r) {
    const double count = count_rad(joint.runs()[r], drive);
    if (e.beyond_counts && !e.beyond_counts(test.value, test.shape, count, joint.views())) return false;
    if (!e.local || count == 0.0) continue;
    const DriveView& view = joint.views()[r];
    if (e.of_one_recording && view.number != static_cast<int>(test.shape[0])) continue;
    furthest = std::max(furthest, furthest_m(e.motions(view, test.shape), test.value, drive.wheelbase_m));
    const bool at_rest = e.of_one_recording && near_a_rest(joint.runs()[r], test.shape[1]);
    least = std::max(least, (at_rest ? kCountsAtRest : kCounts) * count * radius_m);
  }
  return least == 0.0 || furthest > least;
}

constexpr std::size_t kFewestElsewhere = 20;  // to know a scatter from

// Whether some wheel may be on two patches at once. Those without a radius are small.
bool overlap(const Effect& e, const std::vector<double>& a, const std::vector<double>& b, double wheelbase_m) {
  double away_m2 = 0.0, reach_m = 0.0;
  for (std::size_t k = 0; k < e.shapes.size(); ++k) {
    if (e.shapes[k].name == "radius_m")
      reach_m = a[k] + b[k] + wheelbase_m;
    else if (e.shapes[k].unit == "m")
      away_m2 += (a[k] - b[k]) * (a[k] - b[k]);
  }
  return away_m2 < reach_m * reach_m;
}

void judge(ScoredCandidate& c) {
  c.p_value = std::min(1.0, chi_square_tail(c.test.judged(), c.test.freedom) * std::exp(c.log_tests));
}

ScoredCandidate best_of(const JointModel& joint, const CandidateScan& scan, const Effect& e, int without, int tests) {
  ScoredCandidate best;
  best.effect = &e;
  std::vector<std::vector<double>> shapes;
  if (e.scan)
    shapes = e.scan(joint.views());
  else
    shapes.push_back({});
  // Few shapes are tried in every form; where there are many, the best one is.
  const std::size_t forms = std::max<std::size_t>(1, e.forms.size());
  const std::size_t scanned = shapes.size() * forms;
  const bool every_form = forms > 1 && shapes.size() <= 40;
  if (forms > 1) {
    std::vector<std::vector<double>> with_form;
    for (std::size_t form = 0; form < (every_form ? forms : 1); ++form)
      for (std::vector<double> s : shapes) {
        s.push_back(static_cast<double>(every_form ? form : static_cast<std::size_t>(e.form_of_the_scan)));
        with_form.push_back(s);
      }
    shapes = with_form;
  }
  std::vector<double> statistics;
  std::vector<std::size_t> of_shape;  // the number of the shape that each of them belongs to
  const auto take = [&](CandidateTest t, const std::vector<double>& shape) {
    if (t.value.empty() || !physical(e, t.value)) return false;
    if (t.statistic <= best.test.statistic) return false;
    t.shape = shape;
    best.test = std::move(t);
    return true;
  };
  const auto consider = [&](const std::vector<double>& shape) { return take(scan.test(e, shape), shape); };
  std::vector<std::pair<double, std::size_t>> places;  // a place is looked for from several starts
  const std::vector<CandidateTest> scanned_tests = scan.tests(e, shapes);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const CandidateTest& t = scanned_tests[k];
    if (t.freedom > 0 && t.survives > 0.0) statistics.push_back(t.statistic);
    take(t, shapes[k]);
    of_shape.resize(statistics.size(), k);
    if (e.local && e.scan && e.shapes.size() >= 2 && !e.of_one_recording && !statistics.empty())
      places.emplace_back(-statistics.back(), k);
  }
  if (best.test.statistic <= 0.0) return best;
  const double log_tests = std::log(static_cast<double>(tests)) +
                           std::log(e.tests_of_a_shape * static_cast<double>(std::max<std::size_t>(1, scanned)));
  const auto other_forms = [&] {
    for (std::size_t form = 0; form < forms; ++form) {
      std::vector<double> s = best.test.shape;
      s.back() = static_cast<double>(form);
      consider(s);
    }
  };
  if (forms > 1 && !every_form) other_forms();
  // Refined only where there is something to refine.
  if (e.scan && best.test.statistic > 15.0) {
    const auto climb = [&] {
      for (double scale : {1.0, 0.5, 0.25, 0.12, 0.06})
        for (int round = 0; round < 4; ++round) {
          bool moved = false;
          const std::vector<std::vector<double>> near = shapes_near(e, best.test.shape, scale);
          const std::vector<CandidateTest> there = scan.tests(e, near);
          for (std::size_t k = 0; k < near.size(); ++k) moved = take(there[k], near[k]) || moved;
          if (!moved) break;
        }
    };
    climb();
    std::sort(places.begin(), places.end());
    const ScoredCandidate first = best;
    ScoredCandidate top = best;
    for (std::size_t k = 1; k < std::min<std::size_t>(places.size(), 8); ++k) {
      best = first;
      best.test.statistic = 0.0;
      if (!consider(shapes[places[k].second])) continue;
      climb();
      if (best.test.statistic > top.test.statistic) top = best;
    }
    best = top;
    if (forms > 1) other_forms();
  }
  const std::vector<double> shape = best.test.shape;
  best.test = joint.test(joint.columns_of(e, shape), without, !e.local);
  best.test.shape = shape;
  // A patch shows in all others that it overlaps, in a small room in most of them: these are no measure of chance.
  if (e.local && !e.of_one_recording) {
    std::vector<double> elsewhere;
    for (std::size_t n = 0; n < statistics.size(); ++n)
      if (!overlap(e, shapes[of_shape[n]], shape, joint.model.drive.wheelbase_m)) elsewhere.push_back(statistics[n]);
    statistics = std::move(elsewhere);
    if (statistics.size() < kFewestElsewhere) {
      best.test = joint.test(joint.columns_of(e, shape), without, true);
      best.test.shape = shape;
      best.test.cross_validated = best.test.statistic;
    }
  }
  if (e.local && statistics.size() >= kFewestElsewhere) {
    const int k = std::min(3, best.test.freedom);
    best.test.inflation =
        std::max({1.0, quantile(statistics, 0.5) / kMedian[k], quantile(statistics, 0.9) / kNinety[k]});
    best.test.cross_validated = best.test.statistic;
  }
  if (!best.test.value.empty()) best.beyond_counts = beyond_counts(joint, e, best.test);
  best.log_tests = log_tests;
  judge(best);
  return best;
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

bool of_one_moment(const ScoredCandidate& a, const ScoredCandidate& b) {
  return a.effect->of_one_recording && b.effect->of_one_recording && a.test.shape[0] == b.test.shape[0] &&
         std::abs(a.test.shape[1] - b.test.shape[1]) < 0.5;
}

// The same cause in each recording on its own.
bool is_finer(const Effect& own, const Effect& shared) {
  return own.of_each_recording && !shared.of_each_recording && own.name == shared.name &&
         own.component == shared.component;
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
      const DriveView& view = joint.views()[static_cast<std::size_t>(c.test.shape[0])];
      for (const EffectStep& s : view.steps)
        if (std::abs(s.time_s - c.test.shape[1]) < 0.5 &&
            length(s.position - Vec2{a.shape[0], a.shape[1]}) < a.shape[2] + view.drive.wheelbase_m)
          return true;
    }
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
  return joint.fit(3);
}

void fit_noise_too(JointModel& joint) {
  joint.fit_noise();
  joint.fit(2);
}

}  // namespace

std::vector<ScoredCandidate> scored_candidates(const JointModel& joint, double family_wise_error, int without) {
  (void)family_wise_error;
  std::vector<const Effect*> all;
  for (const Effect& e : catalogue()) all.push_back(&e);
  const int runs = static_cast<int>(joint.views().size());
  if (runs > 1)
    for (const auto* of_each : {&effects::wheel_eccentricity_of_each_run(runs), &effects::clock_rate_of_each_run(runs)})
      for (const Effect& e : *of_each) all.push_back(&e);
  bool commands = false;
  for (const DriveView& v : joint.views()) commands = commands || v.from_commands;
  std::vector<ScoredCandidate> scored(all.size());
  const CandidateScan scan(joint, without);
  // Half of the error is for what happens in one place or moment, half for all others: those are few entries, and each
  // was looked for so often that it needs the larger share to be seen at all.
  const auto local = std::count_if(all.begin(), all.end(), [](const Effect* e) { return e->local; });
  const int entries[2] = {2 * static_cast<int>(std::ssize(all) - local), 2 * static_cast<int>(local)};
  parallel_for(static_cast<int>(all.size()), [&](int i) {
    const Effect& e = *all[i];
    scored[i].effect = &e;
    if (e.only_commands && !commands) return;
    // What reads the encoders does not exist where there are none.
    if (commands && (e.name == "encoder_missed_counts" || e.name == "wheel_eccentricity")) return;
    scored[i] = best_of(joint, scan, e, without, entries[e.local ? 1 : 0]);
  });
  // Phases or rates of their own need to gain what so many more parameters gain by chance one time in a thousand.
  for (ScoredCandidate& own : scored)
    for (const ScoredCandidate& shared : scored) {
      const int more = own.test.freedom - shared.test.freedom;
      if (is_finer(*own.effect, *shared.effect) && more > 0 &&
          chi_square_tail(own.test.judged() - shared.test.judged(), more) > 1e-3)
        own.test.statistic = 0.0, own.p_value = 1.0;
    }
  std::sort(scored.begin(), scored.end(),
            [](const ScoredCandidate& a, const ScoredCandidate& b) { return a.test.judged() > b.test.judged(); });
  return scored;
}

Selected select_effects(JointModel& joint, double family_wise_error, const Progress& progress) {
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
    std::vector<ScoredCandidate> scored = scored_candidates(joint, family_wise_error);
    if (step == 0) out.first_look = scored;
    const double distrust = joint.distrust();
    std::vector<const ScoredCandidate*> standing;
    for (const ScoredCandidate& c : scored)
      if (stands(c, family_wise_error) && !of_the_same(joint, c) &&
          c.test.statistic > explained * least_share(*c.effect, distrust))
        standing.push_back(&c);
    std::stable_sort(standing.begin(), standing.end(),
                     [](const ScoredCandidate* a, const ScoredCandidate* b) { return a->p_value < b->p_value; });
    // A push of three numbers fits whatever a bump of one does, and its form is exact: where one number says nearly as
    // much it is the better name.
    for (std::size_t k = 1; k < standing.size(); ++k)
      if (standing[k]->test.freedom < standing[0]->test.freedom && of_one_moment(*standing[k], *standing[0]) &&
          standing[k]->test.judged() > (1.0 - kFormError) * standing[0]->test.judged()) {
        std::rotate(standing.begin(), standing.begin() + static_cast<std::ptrdiff_t>(k),
                    standing.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        break;
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
    if (strongest != standing.end() && strongest != standing.begin() &&
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
      fit_noise_too(joint);
      accepted = kept > 8.0 && is_material(before, before.gathered_error(), joint.gathered_error(),
                                           standing[tried]->test.value.size());
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
          best_of(joint, CandidateScan(joint, static_cast<int>(k)), *a.effect, static_cast<int>(k), 1);
      if (again.test.statistic < now + 1.0) continue;
      a.shape = again.test.shape;
      a.value = again.test.value;
      joint.fit(2);
      joint.fit_noise();
      joint.fit(2);
    }
    if (!goes_on(progress, share += 0.08)) return out;
    // A name may have been the best only while another was missing.
    if (joint.accepted.size() > 1)
      for (std::size_t k = 0; k + 1 < joint.accepted.size(); ++k) {
        if (joint.accepted[k].effect == clocks) continue;
        const std::vector<ScoredCandidate> instead = scored_candidates(joint, family_wise_error, static_cast<int>(k));
        const ScoredCandidate* own = nullptr;
        for (const ScoredCandidate& c : instead)
          if (c.effect == joint.accepted[k].effect) own = &c;
        const ScoredCandidate& top = instead.front();
        const bool taken = std::any_of(joint.accepted.begin(), joint.accepted.end(),
                                       [&](const AcceptedEffect& a) { return a.effect == top.effect; });
        if (own && !taken && stands(top, family_wise_error) &&
            top.test.judged() > own->test.judged() + 2.0 * kClearlyBeaten) {
          joint.accepted.erase(joint.accepted.begin() + static_cast<std::ptrdiff_t>(k));
          let_in(joint, top);
          fit_noise_too(joint);
        }
      }
  }
  // Backward, and what else could have been said in the place of each.
  const auto share_of = [&](std::size_t k) {
    double all = 0.0, own = 0.0;
    for (std::size_t j = 0; j < joint.accepted.size(); ++j) {
      const double t =
          joint.test(joint.columns_of(*joint.accepted[j].effect, joint.accepted[j].shape), static_cast<int>(j))
              .statistic;
      all += t;
      if (j == k) own = t;
    }
    return all > 0.0 ? own / all : 1.0;
  };
  for (std::size_t k = 0; k < joint.accepted.size();) {
    if (with_all.empty()) with_all = scored_candidates(joint, family_wise_error);
    std::vector<ScoredCandidate> instead;
    if (joint.accepted[k].effect == clocks)
      instead.push_back(tested_alone(joint, k));
    else
      instead = scored_candidates(joint, family_wise_error, static_cast<int>(k));
    judge_locals_by(with_all, instead);
    ScoredCandidate own;
    for (const ScoredCandidate& c : instead)
      if (c.effect == joint.accepted[k].effect) own = c;
    const double least = least_share(*joint.accepted[k].effect, joint.distrust());
    if (!own.effect || !stands(own, family_wise_error) || share_of(k) < least) {
      // The score is linear about a model that has the effect; where that is much, only a fit without it tells.
      JointModel without = joint;
      without.accepted.erase(without.accepted.begin() + static_cast<std::ptrdiff_t>(k));
      without.fit(4);
      const double lost = without.minus_two_log_likelihood() - joint.minus_two_log_likelihood();
      without.fit_noise();
      without.fit(2);
      const bool needed =
          lost > 100.0 && share_of(k) > least && lowers(without.gathered_error(), joint.gathered_error(), kMaterial);
      if (!needed) {
        joint = without;
        with_all.clear();
        out.evidence.clear();
        out.alternatives.clear();
        k = 0;
        continue;
      }
      own.effect = joint.accepted[k].effect;
      own.test.shape = joint.accepted[k].shape;
      own.test.statistic = lost;
      own.test.inflation = std::max(1.0, own.test.inflation);
      own.p_value = chi_square_tail(lost / own.test.inflation, static_cast<int>(joint.accepted[k].value.size()));
    }
    std::vector<ScoredCandidate> alternatives;
    for (const ScoredCandidate& c : instead) {
      const bool taken = std::any_of(joint.accepted.begin(), joint.accepted.end(),
                                     [&](const AcceptedEffect& a) { return a.effect == c.effect; });
      if (taken || c.p_value > family_wise_error || !c.beyond_counts || c.effect->name == own.effect->name) continue;
      const bool same_moment = of_one_moment(own, c);
      const double beaten_by = std::max(2.0 * kClearlyBeaten, same_moment ? kFormError * own.test.judged() : 0.0);
      if (own.test.judged() - c.test.statistic / own.test.inflation < beaten_by) alternatives.push_back(c);
    }
    out.evidence.push_back(own);
    out.alternatives.push_back(alternatives);
    ++k;
  }
  return out;
}

}  // namespace odolab
