#include "core/diagnosis/generic/stretches.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "core/base/formatted.h"
#include "core/base/quantile.h"
#include "core/base/two_digits.h"
#include "core/diagnosis/generic/bursts.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/trembling_truth.h"
#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/model/coarse_counts.h"
#include "core/diagnosis/naming/material.h"

namespace odolab {

namespace {

constexpr double kLasts_s[] = {2.0, 4.0, 8.0, 16.0, 32.0};
constexpr double kMostOfARun = 0.5;
constexpr double kStepsOfOne = 4.0;  // from one stretch to the next

enum class Goes { elsewhere, as_wheels_roll };
constexpr Goes kBoth[] = {Goes::elsewhere, Goes::as_wheels_roll};
constexpr auto kWaysToLook = static_cast<double>(std::size(kLasts_s) * std::size(kBoth));

// What a stretch of a run is displaced by: forward, sideways and in heading, spread evenly along the way whichever way
// it goes; or such a share of the way of the left wheel and of the right one, and sideways.
std::vector<Motions> displaced_in(const DriveView& view, int run, double from_s, double to_s, Goes goes) {
  std::vector<Motions> none(3);
  if (view.number != run) return none;
  const std::size_t from = view.step_at(from_s), to = view.step_at(to_s);
  if (from >= to) return none;
  const double base_m = view.drive.wheelbase_m;
  // Turning on the spot is way, too.
  const auto way_m = [&](std::size_t i) { return unit_of_channel(view.steps[i], base_m, 2).turn_rad; };
  double all_m = 0.0;
  for (std::size_t i = from; i < to; ++i) all_m += way_m(i);
  if (!(all_m > 0.0)) return none;
  std::vector<Motions> m(3, Motions(from, to));
  for (std::size_t i = from; i < to; ++i) {
    const double share = way_m(i) / all_m;
    m[1][i].sideways_m = share;
    if (goes == Goes::elsewhere) {
      m[0][i].forward_m = m[2][i].turn_rad = share;
    } else {
      m[0][i] = by_wheel(Wheel::left, view.steps[i].left_m, base_m);
      m[2][i] = by_wheel(Wheel::right, view.steps[i].right_m, base_m);
    }
  }
  return m;
}

// How far both wheels are displaced together.
double displaced_wheels_m(const DriveView& view, double from_s, double to_s, const std::vector<double>& shares) {
  double sum_m = 0.0;
  for (std::size_t i = view.step_at(from_s), to = view.step_at(to_s); i < to; ++i)
    sum_m += std::abs(shares[0] * view.steps[i].left_m) + std::abs(shares[2] * view.steps[i].right_m);
  return sum_m;
}

// Of a stretch's recording, middle, length, and how it goes. Scans remember what they are asked by where it lies, so it
// lives as long as the program.
const Effect& displacement() {
  static const Effect all = [] {
    Effect e;
    e.name = "displaced for a while";
    e.component = "vehicle";
    e.amplitudes.resize(3);
    e.shapes = {{"recording", "1"}, {"at_s", "s"}, {"lasts_s", "s"}, {"goes", "1"}};
    e.local = e.of_one_recording = true;
    e.motions = [](const DriveView& view, const std::vector<double>& shape) {
      return displaced_in(view, static_cast<int>(shape[0]), shape[1] - 0.5 * shape[2], shape[1] + 0.5 * shape[2],
                          static_cast<Goes>(shape[3]));
    };
    return e;
  }();
  return all;
}

std::vector<std::vector<double>> stretches_of(const std::vector<DriveView>& views, double lasts_s, Goes goes) {
  std::vector<std::vector<double>> shapes;
  for (const DriveView& view : views) {
    if (view.steps.empty()) continue;
    const double begins_s = view.steps.front().time_s, ends_s = view.steps.back().time_s;
    if (lasts_s > kMostOfARun * (ends_s - begins_s)) continue;
    const double stride_s = lasts_s / kStepsOfOne;
    for (double at_s = begins_s + 0.5 * lasts_s; at_s < ends_s - 0.5 * lasts_s; at_s += stride_s) {
      const std::size_t next = view.step_at(at_s + 0.5 * lasts_s);
      if (view.step_at(at_s - 0.5 * lasts_s) < next) {
        shapes.push_back({static_cast<double>(view.number), at_s, lasts_s, static_cast<double>(goes)});
      } else if (next < view.steps.size()) {  // a pause, however long
        const double until_s = view.steps[next].time_s - 0.5 * lasts_s;
        at_s += stride_s * std::max(0.0, std::floor((until_s - at_s) / stride_s));
      }
    }
  }
  return shapes;
}

struct Displaced {
  Burst burst;
  double lasts_s = 0.0;
  Goes goes = Goes::elsewhere;
  std::vector<double> by;  // as of `displaced_in`
  double inflation = 1.0;  // of its statistic
  std::vector<double> shape() const {
    return {static_cast<double>(burst.run), burst.at_s, lasts_s, static_cast<double>(goes)};
  }
  double from_s() const { return burst.at_s - 0.5 * lasts_s; }
  double to_s() const { return burst.at_s + 0.5 * lasts_s; }
};

std::vector<Burst> bursts_in(const std::vector<Displaced>& stretches) {
  std::vector<Burst> bursts;
  for (const Displaced& d : stretches) bursts.push_back(d.burst);
  return bursts;
}

// Those of one length that are further beyond noise than any that they share time with; the largest first.
std::vector<Displaced> standing_apart(std::vector<Displaced> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Displaced& a, const Displaced& b) { return a.burst.excess > b.burst.excess; });
  std::vector<Displaced> chosen;
  for (Displaced& s : all) {
    const auto shares = [&](const Displaced& other) {
      return other.burst.run == s.burst.run && other.from_s() < s.to_s() && s.from_s() < other.to_s();
    };
    if (std::none_of(chosen.begin(), chosen.end(), shares)) chosen.push_back(std::move(s));
  }
  return chosen;
}

std::vector<Displaced> displaced_by_more(const JointModel& joint, const CandidateScan& scan,
                                         const TremblingTruth& truth, double lasts_s, Goes goes) {
  const std::vector<std::vector<double>> shapes = stretches_of(joint.views(), lasts_s, goes);
  std::vector<CandidateTest> tests = scan.tests(displacement(), shapes);
  std::vector<double> statistics;
  for (const CandidateTest& t : tests)
    if (t.freedom == kFreedomOfAPush && t.survives > 0.0) statistics.push_back(t.statistic);
  // By the median, which what happens for a while does not move.
  const double scatter = std::max(doubt_of_moments(joint), median(statistics) / kMiddleOfAPush);
  std::vector<Displaced> all;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    CandidateTest& t = tests[k];
    if (t.freedom < kFreedomOfAPush || t.survives <= 0.0 || t.statistic <= kNinetySevenOfAPush * scatter) continue;
    const auto run = static_cast<int>(shapes[k][0]);
    Displaced d{{run, shapes[k][1], 0.0}, lasts_s, goes, std::move(t.value)};
    const DriveView& view = joint.views()[static_cast<std::size_t>(run)];
    const std::vector<double> push =
        goes == Goes::elsewhere ? d.by
                                : std::vector{displaced_wheels_m(view, d.from_s(), d.to_s(), d.by), d.by[1], 0.0};
    if (hides_behind_counts(push, joint)) continue;
    d.inflation = std::max(scatter, truth.worse(run, d.burst.at_s));
    d.burst.excess = t.statistic / d.inflation - kNinetySevenOfAPush;
    if (d.burst.excess > 0.0) all.push_back(std::move(d));
  }
  return standing_apart(std::move(all));
}

// From when to when it goes on: either end moves as long as that says more.
void find_ends(Displaced& d, const CandidateScan& scan) {
  constexpr double kKnownTo_s = 0.2;
  const std::vector<EffectStep>& steps = scan.joint().views()[static_cast<std::size_t>(d.burst.run)].steps;
  const double longest_s = kMostOfARun * (steps.back().time_s - steps.front().time_s);
  double statistic = scan.test(displacement(), d.shape()).statistic;
  bool moved = false;
  for (double step_s = d.lasts_s / kStepsOfOne; step_s > kKnownTo_s; step_s *= moved ? 1.0 : 0.5) {
    std::vector<std::vector<double>> shapes;
    for (const double from : {-step_s, 0.0, step_s})
      for (const double to : {-step_s, 0.0, step_s}) {
        const double from_s = std::max(d.from_s() + from, steps.front().time_s),
                     to_s = std::min(d.to_s() + to, steps.back().time_s);
        if (to_s - from_s > step_s && to_s - from_s <= longest_s)
          shapes.push_back({d.shape()[0], 0.5 * (from_s + to_s), to_s - from_s, d.shape()[3]});
      }
    std::vector<CandidateTest> tests = scan.tests(displacement(), shapes);
    moved = false;
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      if (tests[k].freedom < kFreedomOfAPush || tests[k].statistic <= statistic) continue;
      d.burst.excess += (tests[k].statistic - statistic) / d.inflation;
      statistic = tests[k].statistic;
      d.burst.at_s = shapes[k][1], d.lasts_s = shapes[k][2], d.by = tests[k].value;
      moved = true;
    }
  }
}

std::string displaced_in_words(const std::vector<Displaced>& stretches, const JointModel& joint) {
  std::string words;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const Displaced& s = stretches[k];
    words += (k == 0 ? "" : "; ") + joint.runs()[static_cast<std::size_t>(s.burst.run)].name +
             formatted(" from %.1f to %.1f s by ", s.from_s(), s.to_s());
    if (s.goes == Goes::elsewhere)
      words += two_digits(1e3 * std::hypot(s.by[0], s.by[1])) + " mm and " +
               two_digits(std::abs(s.by[2]) * 180.0 / kPi) + " degrees";
    else
      words += formatted("%+.2g %% of the left wheel's way and %+.2g %% of the right one's", 100.0 * s.by[0],
                         100.0 * s.by[2]);
  }
  return words;
}

// In each run, from the first moment to the last in which it may go on. Empty where that is so often, or for so long,
// that it is no incident.
std::vector<TimeStretches> incidents_of(const std::vector<Displaced>& stretches, const JointModel& joint) {
  constexpr double kMostOfAll = 0.2, kToEitherSide = 0.05;
  std::vector<TimeStretches> of(joint.runs().size());
  double sum_s = 0.0, all_s = 0.0;
  for (const Displaced& s : stretches) {
    const double beside_s = std::max(0.5, kToEitherSide * s.lasts_s);
    of[static_cast<std::size_t>(s.burst.run)].emplace_back(s.from_s() - beside_s, s.to_s() + beside_s);
  }
  for (std::size_t r = 0; r < of.size(); ++r) {
    of[r] = joined(std::move(of[r]));
    for (const auto& [from_s, to_s] : of[r]) sum_s += to_s - from_s;
    const std::vector<WheelSample>& wheels = joint.runs()[r].wheels;
    all_s += wheels.back().time_s - wheels.front().time_s;
  }
  return sum_s <= kMostOfAll * all_s ? of : std::vector<TimeStretches>{};
}

}  // namespace

std::optional<Unnamed> what_goes_on_for_a_while(const JointModel& joint, double explained, double error) {
  if (is_nothing(joint.gathered_error()) || counts_are_coarse(joint)) return std::nullopt;
  if (joint.truth_errors) return std::nullopt;  // whose place and heading err together for as long
  const CandidateScan scan(joint, JointModel::kNone);
  const TremblingTruth truth(joint);
  std::vector<Displaced> found;
  double p_value = error, gain = 0.0;
  for (const double lasts_s : kLasts_s)
    for (const Goes goes : kBoth) {
      std::vector<Displaced> of = displaced_by_more(joint, scan, truth, lasts_s, goes);
      const std::vector<Burst> bursts = bursts_in(of);
      if (bursts.empty()) continue;
      const double by_chance = kWaysToLook * chance_of(bursts), more = beyond_noise(bursts);
      if (by_chance >= p_value || more < kMostLeft * explained) continue;
      found = std::move(of), p_value = by_chance, gain = more;
    }
  if (found.empty()) return std::nullopt;
  // Of the others noise may be the cause, beside the largest.
  constexpr std::size_t kMostSaid = 3;
  constexpr double kBesideTheLargest = 0.2;
  const double least = kBesideTheLargest * found.front().burst.excess;
  const auto beside_it =
      std::count_if(found.begin(), found.end(), [&](const Displaced& d) { return d.burst.excess > least; });
  found.resize(std::min(static_cast<std::size_t>(beside_it), kMostSaid));
  for (Displaced& d : found) find_ends(d, scan);
  found = standing_apart(std::move(found));
  Unnamed u;
  u.p_value = p_value;
  u.gain = std::max(gain, beyond_noise(bursts_in(found)));
  u.where.recording = joint.runs()[static_cast<std::size_t>(found.front().burst.run)].name;
  u.where.time_s = {{found.front().from_s(), found.front().to_s()}};
  u.where.regime = "for a while the vehicle goes elsewhere than its wheels roll, further than noise takes it (" +
                   displaced_in_words(found, joint) + ")";
  if (static_cast<std::size_t>(beside_it) <= kMostSaid) u.incidents = incidents_of(found, joint);
  return u;
}

}  // namespace odolab
