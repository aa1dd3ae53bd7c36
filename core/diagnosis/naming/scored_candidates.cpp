#include "core/diagnosis/naming/scored_candidates.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/model/driven_again.h"
#include "core/diagnosis/model/score_by_batches.h"
#include "core/diagnosis/naming/shape_search.h"

namespace odolab {

namespace {

// Whether the only amplitude has one sign, so that chance makes it the other way, which is none, as often. Not of
// places and moments, where floors are uneven a little in earnest.
bool is_one_sided(const Effect& e) {
  return !e.local && e.amplitudes.size() == 1 && (e.amplitudes[0].low >= 0.0 || e.amplitudes[0].high <= 0.0);
}

bool near_a_rest(const InnovationRun& run, double time_s) {
  constexpr double kNear_s = 0.5;
  for (std::size_t i = 0; i < run.settles.size(); ++i)
    if (run.settles[i] && std::abs(0.5 * (run.wheels[i].time_s + run.wheels[i + 1].time_s) - time_s) < kNear_s)
      return true;
  return false;
}

// How far a wheel, or the vehicle sideways, is carried in each go at most, squared; the sum over all goes.
double carried_m2(const std::vector<Motions>& motions, const std::vector<double>& value, double wheelbase_m) {
  std::size_t first = static_cast<std::size_t>(-1), end = 0;
  for (const Motions& m : motions)
    if (!m.empty()) first = std::min(first, m.first()), end = std::max(end, m.end());
  double sum_m2 = 0.0, furthest_m = 0.0;
  BodyMotion carried;
  for (std::size_t i = first; i < end; ++i) {
    BodyMotion by;
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const BodyMotion m = motions[k].at(i);
      by.forward_m += value[k] * m.forward_m;
      by.sideways_m += value[k] * m.sideways_m;
      by.turn_rad += value[k] * m.turn_rad;
    }
    if (by.forward_m == 0.0 && by.sideways_m == 0.0 && by.turn_rad == 0.0) {
      sum_m2 += furthest_m * furthest_m;
      carried = {}, furthest_m = 0.0;
      continue;
    }
    carried.forward_m += by.forward_m;
    carried.sideways_m += by.sideways_m;
    carried.turn_rad += by.turn_rad;
    furthest_m = std::max({furthest_m, std::abs(carried.sideways_m),
                           std::abs(carried.forward_m) + 0.5 * wheelbase_m * std::abs(carried.turn_rad)});
  }
  return sum_m2 + furthest_m * furthest_m;
}

// A wheel's count is off by what is hidden between two of them: that averages out on the way, but not at an even speed
// that is nearly a whole number of counts from one reading to the next; and it stays where the wheel stops. What comes
// back each time is told from it the better the oftener it came, as the root of how often.
bool beyond_counts(const JointModel& joint, const Effect& e, const CandidateTest& test) {
  constexpr double kCounts = 1.5, kCountsAtRest = 2.0;
  const DifferentialDrive& drive = joint.model.drive;
  const double radius_m = std::max(drive.wheel_radius_left_m, drive.wheel_radius_right_m);
  double sum_m2 = 0.0, least_m = 0.0;
  for (std::size_t r = 0; r < joint.runs().size(); ++r) {
    const double count = count_rad(joint.runs()[r], drive);
    if (e.beyond_counts && !e.beyond_counts(test.value, test.shape, count, joint.views())) return false;
    if (!e.local || (count == 0.0 && joint.truth_feigns_m == 0.0)) continue;
    const DriveView& view = joint.views()[r];
    if (e.of_one_recording && view.number != static_cast<int>(test.shape[0])) continue;
    sum_m2 += carried_m2(e.motions(view, test.shape), test.value, drive.wheelbase_m);
    const bool at_rest = e.of_one_recording && near_a_rest(joint.runs()[r], test.shape[1]);
    least_m = std::max({least_m, (at_rest ? kCountsAtRest : kCounts) * count * radius_m, joint.truth_feigns_m});
  }
  return least_m == 0.0 || sum_m2 > least_m * least_m;
}

constexpr std::size_t kFewestElsewhere = 20;  // to know a scatter from

// Whether some wheel may be on two patches at once; or two small places are so near each other that the truth does not
// tell which was met.
bool overlap(const Effect& e, const std::vector<double>& a, const std::vector<double>& b, double wheelbase_m) {
  constexpr double kNear_m = 0.5;
  const Apart p = apart(e, a, b);
  const double reach_m = p.radii_m > 0.0 ? p.radii_m + wheelbase_m : kNear_m;
  return p.away_m2 < reach_m * reach_m;
}

// The same place, met by one wheel alone.
bool is_met_by_one_of(const Effect& one, const Effect& either) {
  return either.local && !either.of_one_recording && either.component == component_of(Wheel::both) && one.local &&
         !one.of_one_recording && one.name == either.name && one.component != either.component;
}

// The same at one place of a line, by that wheel or whichever comes there.
bool is_one_place_of(const Effect& place, const Effect& line) {
  return lies_across(line) && place.name == line.name && !place.of_one_recording && !lies_across(place) &&
         (place.component == line.component || place.component == component_of(Wheel::both));
}

// The same by a wheel of that place, at one moment of one recording.
bool happens_once_of(const Effect& once, const Effect& each_time) {
  return once.local && once.of_one_recording && each_time.local && !each_time.of_one_recording &&
         once.name == each_time.name &&
         (once.component == each_time.component || each_time.component == component_of(Wheel::both));
}

// Whether the wheels rest about a moment of one recording.
bool rests_at(const JointModel& joint, const std::vector<double>& moment) {
  constexpr double kAbout_s = 0.1;
  const std::vector<EffectStep>& steps = joint.views()[static_cast<std::size_t>(moment[0])].steps;
  auto step = std::lower_bound(steps.begin(), steps.end(), moment[1] - kAbout_s,
                               [](const EffectStep& s, double t) { return s.time_s < t; });
  bool any = false;
  for (; step != steps.end() && step->time_s < moment[1] + kAbout_s; ++step) {
    if (step->left_read_rad != 0.0 || step->right_read_rad != 0.0) return false;
    any = true;
  }
  return any;
}

// From the truth's last sample before a moment to the first behind it, on the wheels' clock: what happened in between
// happened at any moment of these.
std::pair<double, double> between_samples(const JointModel& joint, const std::vector<double>& moment) {
  const int run = static_cast<int>(moment[0]);
  const std::vector<TruthSample>& truth = joint.runs()[static_cast<std::size_t>(run)].truth;
  const TwoClocks clocks = joint.clocks(run);
  const auto next = std::lower_bound(truth.begin(), truth.end(), moment[1], [&](const TruthSample& t, double at_s) {
    return clocks.wheels_stamp_s(t.time_s) < at_s;
  });
  if (next == truth.begin() || next == truth.end()) return {moment[1], moment[1]};
  return {clocks.wheels_stamp_s((next - 1)->time_s), clocks.wheels_stamp_s(next->time_s)};
}

// Whether a candidate that is another one and more says too little beside that.
bool says_too_little(const ScoredCandidate& c, const ScoredCandidate& simpler) {
  // Of both by one scale: the scatter elsewhere of one and of the other has nothing to do with which is right.
  const double scale = std::max(c.test.inflation, simpler.test.inflation);
  // Phases or rates of their own need to gain what so many more parameters gain by chance one time in a thousand.
  const int more = c.test.freedom - simpler.test.freedom;
  if (is_finer(*c.effect, *simpler.effect))
    return more > 0 && chi_square_tail((c.test.statistic - simpler.test.statistic) / scale, more) > 1e-3;
  constexpr int kNumbersOfALine = 2;  // its direction and its length
  if (is_one_place_of(*simpler.effect, *c.effect))
    return chi_square_tail(std::max(0.0, c.test.statistic - simpler.test.statistic) / scale, kNumbersOfALine) > 1e-3;
  // What is said of either wheel must say more than of one, by two standard errors; and what is said to come back each
  // time more than that it happened once, by more than another form does.
  constexpr double kMore = 4.0, kMoreThanAForm = 1.25;
  const double by_more = simpler.test.statistic + kMore * c.test.inflation;
  if (is_met_by_one_of(*simpler.effect, *c.effect)) return c.test.statistic < by_more;
  if (happens_once_of(*simpler.effect, *c.effect))
    return c.test.statistic < std::max(by_more, kMoreThanAForm * simpler.test.statistic);
  return false;
}

}  // namespace

void judge(ScoredCandidate& c) {
  c.p_value = std::min(
      1.0, scaled_chi_square_tail(c.test.judged(), c.test.freedom, c.test.feigned.squares) * std::exp(c.log_tests));
}

ScoredCandidate scored_candidate(const JointModel& joint, const CandidateScan& scan, const Effect& e,
                                 const Sought& sought) {
  const int without = sought.without;
  ScoredCandidate best;
  best.effect = &e;
  SearchedShapes searched = best_shape(joint.views(), scan, e, sought.also_from, sought.worth_refining);
  best.test = std::move(searched.best);
  if (best.test.statistic <= 0.0) return best;
  const double log_tests = std::log(static_cast<double>(sought.tests) * (is_one_sided(e) ? 0.5 : 1.0)) +
                           std::log(e.tests_of_a_shape * static_cast<double>(searched.tried));
  const std::vector<double> shape = best.test.shape;
  best.test = joint.test(joint.columns_of(e, shape), without, !e.local);
  best.test.shape = shape;
  // A place shows in all others that it overlaps, in a small room in most of them, and a moment in all between the same
  // two samples of the truth: these are no measure of chance.
  const auto shape_of = [&](std::size_t n) -> const std::vector<double>& {
    return searched.shapes[searched.of_shape[n]];
  };
  std::vector<std::size_t> elsewhere;
  const auto [from_s, to_s] = e.of_one_recording ? between_samples(joint, shape) : std::pair{0.0, 0.0};
  for (std::size_t n = 0; e.local && n < searched.statistics.size(); ++n) {
    const std::vector<double>& other = shape_of(n);
    if (e.of_one_recording ? other[0] != shape[0] || other[1] <= from_s || other[1] >= to_s
                           : !overlap(e, other, shape, joint.model.drive.wheelbase_m))
      elsewhere.push_back(n);
  }
  const auto scatter_of = [&](const std::vector<std::size_t>& others) {
    std::vector<double> statistics;
    for (const std::size_t n : others) statistics.push_back(searched.statistics[n]);
    return scatter_of_statistics(statistics, best.test.freedom);
  };
  if (e.local && !e.of_one_recording && elsewhere.size() < kFewestElsewhere) {
    best.test = joint.test(joint.columns_of(e, shape), without, true);
    best.test.shape = shape;
    best.test.cross_validated = best.test.statistic;
  }
  if (elsewhere.size() >= kFewestElsewhere) {
    best.test.inflation = std::max(1.0, scatter_of(elsewhere));
    best.test.cross_validated = best.test.statistic;
    // While the wheels rest nothing hides the truth's own slow noise: there it is judged by other rests too.
    if (e.of_one_recording && rests_at(joint, shape)) {
      std::vector<std::size_t> at_rest = elsewhere;
      std::erase_if(at_rest, [&](std::size_t n) { return !rests_at(joint, shape_of(n)); });
      if (at_rest.size() >= kFewestElsewhere) best.test.inflation = std::max(best.test.inflation, scatter_of(at_rest));
    }
  }
  // A truth that is worse for a while, as of a tracker that loses a marker, tells as much less of what happens then.
  if (e.local && e.of_one_recording)
    best.test.inflation = std::max(
        best.test.inflation,
        joint.scatter_about(static_cast<int>(shape[0]), shape[1], joint.columns_of(e, shape), best.test.value));
  if (!best.test.value.empty()) best.beyond_counts = beyond_counts(joint, e, best.test);
  best.log_tests = log_tests;
  judge(best);
  return best;
}

bool is_finer(const Effect& own, const Effect& shared) {
  return own.of_each_recording && !shared.of_each_recording && own.name == shared.name &&
         own.component == shared.component;
}

namespace {

constexpr double kWorthAsking = 0.05;  // of a p value

bool is_looked_for_at_places(const Effect& e) { return e.local && !e.of_one_recording && e.scan; }

// What is small, and is climbed otherwise than the scan asks, is missed by all its points: it is looked for as well
// where something else that lies on the floor says more.
void look_where_others_lie(const JointModel& joint, const CandidateScan& scan, int without, int tests,
                           std::vector<ScoredCandidate>& scored) {
  std::vector<std::vector<std::vector<double>>> also_from(scored.size());
  for (std::size_t i = 0; i < scored.size(); ++i)
    for (const ScoredCandidate& other : scored)
      if (is_looked_for_at_places(*scored[i].effect) && !is_a_patch(*scored[i].effect) &&
          is_looked_for_at_places(*other.effect) && other.p_value < kWorthAsking &&
          other.test.statistic > scored[i].test.statistic)
        also_from[i].push_back({other.test.shape[0], other.test.shape[1]});
  parallel_for(static_cast<int>(scored.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    if (also_from[k].empty()) return;
    ScoredCandidate again = scored_candidate(joint, scan, *scored[k].effect, {without, tests, also_from[k]});
    if (again.test.statistic > scored[k].test.statistic) scored[k] = std::move(again);
  });
}

void hold_against_readings(const JointModel& joint, std::vector<ScoredCandidate>& scored) {
  std::vector<ScoredCandidate*> worth;
  for (ScoredCandidate& c : scored)
    if (!c.effect->local && c.p_value < kWorthAsking) worth.push_back(&c);
  if (!joint.driven_again || worth.empty()) return;
  joint.driven_again->drive();
  parallel_for(static_cast<int>(worth.size()), [&](int i) {
    ScoredCandidate& c = *worth[static_cast<std::size_t>(i)];
    widen_by_readings(c.test, joint, *c.effect, c.test.shape);
    judge(c);
  });
}

// What is over in a moment, so that a truth that jumps looks like it.
bool is_short(const Effect& e) { return e.local && (e.of_one_recording || e.name == "bump"); }

}  // namespace

std::vector<ScoredCandidate> scored_candidates(const JointModel& joint, int without) {
  std::vector<const Effect*> all;
  for (const Effect& e : catalogue())
    all.push_back(joint.shows_at_rest(e) ? &effects::truth_smoothing_seen_at_rest(joint.truth_smoothed_for_s) : &e);
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
  constexpr double kMayCatchUp = 0.2;  // a sharp place shows half of what it says, or less, beside itself
  double worth_refining = 0.0;
  if (without >= 0) {
    const AcceptedEffect& a = joint.accepted[static_cast<std::size_t>(without)];
    worth_refining = kMayCatchUp * joint.test(joint.columns_of(*a.effect, a.shape), without).statistic;
  }
  parallel_for(static_cast<int>(all.size()), [&](int i) {
    const Effect& e = *all[i];
    scored[i].effect = &e;
    if (e.only_commands && !commands) return;
    if (joint.truth_jumps && is_short(e)) return;
    // What reads the encoders does not exist where there are none.
    if (commands && (e.name == "encoder_missed_counts" || e.name == "wheel_eccentricity")) return;
    scored[i] = scored_candidate(joint, scan, e, {without, entries[e.local ? 1 : 0], {}, worth_refining});
  });
  look_where_others_lie(joint, scan, without, entries[1], scored);
  hold_against_readings(joint, scored);
  std::vector<char> in_vain(scored.size(), 0);
  for (std::size_t i = 0; i < scored.size(); ++i)
    in_vain[i] = std::any_of(scored.begin(), scored.end(),
                             [&](const ScoredCandidate& simpler) { return says_too_little(scored[i], simpler); });
  for (std::size_t i = 0; i < scored.size(); ++i)
    if (in_vain[i]) scored[i].test.statistic = 0.0, scored[i].p_value = 1.0;
  std::sort(scored.begin(), scored.end(),
            [](const ScoredCandidate& a, const ScoredCandidate& b) { return a.test.judged() > b.test.judged(); });
  return scored;
}

namespace {

constexpr double kSaysMore = 1.0;  // by so much of the statistic a shape is taken for another

void find_form_again(JointModel& joint, std::size_t k) {
  AcceptedEffect& a = joint.accepted[k];
  if (a.effect->forms.size() < 2 || a.is_held) return;
  const auto own = static_cast<std::size_t>(a.shape.back());
  CandidateTest best = tested_in_form(joint, k, own);
  best.statistic += kSaysMore;
  bool other = false;
  for (std::size_t form = 0; form < a.effect->forms.size(); ++form) {
    if (form == own) continue;
    CandidateTest t = tested_in_form(joint, k, form);
    if (t.statistic < best.statistic || !is_physical(joint, *a.effect, t.value, t.shape)) continue;
    best = std::move(t);
    other = true;
  }
  if (!other) return;
  a.shape = best.shape;
  a.value = best.value;
  joint.fit(3);
  joint.fit_noise_and_all();
}

}  // namespace

void find_places_again(JointModel& joint) {
  for (std::size_t k = 0; k < joint.accepted.size(); ++k) {
    AcceptedEffect& a = joint.accepted[k];
    if (a.effect->shape_follows_amplitude) {
      find_form_again(joint, k);
      continue;
    }
    if (!a.effect->scan) continue;
    const int own = static_cast<int>(k);
    const double now = joint.test(joint.columns_of(*a.effect, a.shape), own).statistic;
    const ScoredCandidate again = scored_candidate(joint, CandidateScan(joint, own), *a.effect, {.without = own});
    if (again.test.statistic < now + kSaysMore) continue;
    a.shape = again.test.shape;
    a.value = again.test.value;
    joint.fit(2);
    joint.fit_noise_and_all();
  }
}

}  // namespace odolab
