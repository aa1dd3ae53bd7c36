#include "core/diagnosis/naming/scored_candidates.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"

namespace odolab {

namespace {

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

// Whether the only amplitude has one sign, so that chance makes it the other way, which is none, as often. Not of
// places and moments, where floors are uneven a little in earnest.
bool is_one_sided(const Effect& e) {
  return !e.local && e.amplitudes.size() == 1 && (e.amplitudes[0].low == 0.0 || e.amplitudes[0].high == 0.0);
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
    if (!e.local || count == 0.0) continue;
    const DriveView& view = joint.views()[r];
    if (e.of_one_recording && view.number != static_cast<int>(test.shape[0])) continue;
    sum_m2 += carried_m2(e.motions(view, test.shape), test.value, drive.wheelbase_m);
    const bool at_rest = e.of_one_recording && near_a_rest(joint.runs()[r], test.shape[1]);
    least_m = std::max(least_m, (at_rest ? kCountsAtRest : kCounts) * count * radius_m);
  }
  return least_m == 0.0 || sum_m2 > least_m * least_m;
}

constexpr std::size_t kFewestElsewhere = 20;  // to know a scatter from

// Two places: the square of how far they are apart, and their radii together; those without a radius are small.
struct Apart {
  double away_m2 = 0.0, radii_m = 0.0;
};

Apart apart(const Effect& e, const std::vector<double>& a, const std::vector<double>& b) {
  Apart p;
  for (std::size_t k = 0; k < e.shapes.size(); ++k) {
    if (e.shapes[k].name == "radius_m")
      p.radii_m = a[k] + b[k];
    else if (e.shapes[k].unit == "m")
      p.away_m2 += (a[k] - b[k]) * (a[k] - b[k]);
  }
  return p;
}

// Whether some wheel may be on two patches at once.
bool overlap(const Effect& e, const std::vector<double>& a, const std::vector<double>& b, double wheelbase_m) {
  const Apart p = apart(e, a, b);
  const double reach_m = p.radii_m > 0.0 ? p.radii_m + wheelbase_m : 0.0;
  return p.away_m2 < reach_m * reach_m;
}

// So near each other that what is looked for from one is found from the other.
bool is_one_place(const Effect& e, const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kSmall_m = 0.25;
  const Apart p = apart(e, a, b);
  const double near_m = std::max(kSmall_m, 0.5 * p.radii_m);
  return p.away_m2 < near_m * near_m;
}

// The same place, met by one wheel alone.
bool is_met_by_one_of(const Effect& one, const Effect& either) {
  return either.local && !either.of_one_recording && either.component == component_of(Wheel::both) && one.local &&
         !one.of_one_recording && one.name == either.name && one.component != either.component;
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

// The median and the ninetieth hundredth of statistics, against those of chance.
double scatter_of(const std::vector<double>& statistics, int freedom) {
  const int k = std::min(3, freedom);
  return std::max(quantile(statistics, 0.5) / kMedian[k], quantile(statistics, 0.9) / kNinety[k]);
}

// Whether a candidate that is another one and more says too little beside that.
bool says_too_little(const ScoredCandidate& c, const ScoredCandidate& simpler) {
  // Phases or rates of their own need to gain what so many more parameters gain by chance one time in a thousand.
  const int more = c.test.freedom - simpler.test.freedom;
  if (is_finer(*c.effect, *simpler.effect))
    return more > 0 && chi_square_tail(c.test.judged() - simpler.test.judged(), more) > 1e-3;
  // What is said of either wheel must say more than of one, by two standard errors; and what is said to come back each
  // time more than that it happened once, by more than another form does.
  // Of both by one scale: the scatter elsewhere of one and of the other has nothing to do with which is right.
  constexpr double kMore = 4.0, kMoreThanAForm = 1.25;
  const double by_more = simpler.test.statistic + kMore * c.test.inflation;
  if (is_met_by_one_of(*simpler.effect, *c.effect)) return c.test.statistic < by_more;
  if (happens_once_of(*simpler.effect, *c.effect))
    return c.test.statistic < std::max(by_more, kMoreThanAForm * simpler.test.statistic);
  return false;
}

}  // namespace

void judge(ScoredCandidate& c) {
  c.p_value = std::min(1.0, chi_square_tail(c.test.judged(), c.test.freedom) * std::exp(c.log_tests));
}

ScoredCandidate scored_candidate(const JointModel& joint, const CandidateScan& scan, const Effect& e, int without,
                                 int tests) {
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
  const double log_tests = std::log(static_cast<double>(tests) * (is_one_sided(e) ? 0.5 : 1.0)) +
                           std::log(e.tests_of_a_shape * static_cast<double>(std::max<std::size_t>(1, scanned)));
  const auto other_forms = [&] {
    for (std::size_t form = 0; form < forms; ++form) {
      std::vector<double> s = best.test.shape;
      s.back() = static_cast<double>(form);
      consider(s);
    }
  };
  if (forms > 1 && !every_form) other_forms();
  // Refined only where there is something to refine: a place, or a limit of speed, is sharp, and half of what it says,
  // or less, shows beside it.
  constexpr double kWorthRefining = 7.0, kWorthAnotherStart = 10.0;
  if (e.scan && best.test.statistic > kWorthRefining) {
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
    if (forms > 1 && !places.empty()) other_forms(), climb();
    std::sort(places.begin(), places.end());
    const ScoredCandidate first = best;
    ScoredCandidate top = best;
    constexpr std::size_t kStarts = 4;
    constexpr double kWorthAStart = 0.5;  // of the best place that was scanned
    std::vector<std::size_t> starts;
    for (const auto& [minus_statistic, k] : places) {
      if (starts.size() >= kStarts || -minus_statistic < kWorthAnotherStart ||
          minus_statistic > kWorthAStart * places.front().first)
        break;
      const auto is_one_with = [&, k = k](std::size_t other) { return is_one_place(e, shapes[k], shapes[other]); };
      if (std::any_of(starts.begin(), starts.end(), is_one_with)) continue;
      starts.push_back(k);
    }
    for (std::size_t n = 1; n < starts.size(); ++n) {  // the first is where it began
      best = first;
      best.test.statistic = 0.0;
      if (!consider(shapes[starts[n]])) continue;
      if (forms > 1) other_forms();
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
    best.test.inflation = std::max(1.0, scatter_of(statistics, best.test.freedom));
    best.test.cross_validated = best.test.statistic;
    // While the wheels rest nothing hides the truth's own slow noise: there it is judged by other rests too.
    if (e.of_one_recording && rests_at(joint, shape)) {
      std::vector<double> at_rest;
      for (std::size_t n = 0; n < statistics.size(); ++n)
        if (rests_at(joint, shapes[of_shape[n]])) at_rest.push_back(statistics[n]);
      if (at_rest.size() >= kFewestElsewhere)
        best.test.inflation = std::max(best.test.inflation, scatter_of(at_rest, best.test.freedom));
    }
  }
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

// What is over in a moment, so that a truth that jumps looks like it.
bool is_short(const Effect& e) { return e.local && (e.of_one_recording || e.name == "bump"); }

}  // namespace

std::vector<ScoredCandidate> scored_candidates(const JointModel& joint, int without) {
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
    if (joint.truth_jumps && is_short(e)) return;
    // What reads the encoders does not exist where there are none.
    if (commands && (e.name == "encoder_missed_counts" || e.name == "wheel_eccentricity")) return;
    scored[i] = scored_candidate(joint, scan, e, without, entries[e.local ? 1 : 0]);
  });
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

}  // namespace odolab
