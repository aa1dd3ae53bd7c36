#include "core/diagnosis/model/driven_again.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/calibration/averaged_truth.h"
#include "core/calibration/fewer_readings.h"
#include "core/calibration/rests.h"
#include "core/calibration/slow_counts.h"
#include "core/calibration/smoothed_readings.h"
#include "core/diagnosis/model/turned_truth.h"

namespace odolab {

namespace {

// How often drives are driven again: those of hours, each of whose models is large, less often.
struct Times {
  std::size_t fewest, most, samples;  // of the truth, in all
  int of(const JointModel& joint) const {
    std::size_t each = 1;
    for (const InnovationRun& run : joint.runs()) each += run.truth.size();
    return static_cast<int>(std::clamp(samples / each, fewest, most));
  }
};
constexpr Times kCounted{6, 20, 400000}, kRolled{2, 6, 100000}, kTurned{4, 8, 150000};

// Within a count, where wheels rest: nobody knows, so each is tried in turn.
enum class Where { as_read, anywhere, further };

// Of one wheel as its readings, smoothed, say, but that it stands somewhere within the count where it rests, on a
// straight line from rest to rest.
void stand_anywhere(std::vector<WheelSample>& wheels, double WheelSample::*wheel, double count, Random& random) {
  const auto n = static_cast<int>(wheels.size());
  double was = count * (random.uniform() - 0.5);
  const std::vector<WheelSample> before = wheels;
  for (int i = 0; i < n;) {
    // From `i`, on the way, to where it comes to rest.
    const auto rests_until = [&](int from) {
      int until = from;
      while (until + 1 < n && before[until + 1].*wheel == before[from].*wheel) ++until;
      return before[until].time_s - before[from].time_s > kRest_s ? until : from;
    };
    int end = i;
    while (end + 1 < n && rests_until(end) == end) ++end;
    const double is = count * (random.uniform() - 0.5), lasts_s = before[end].time_s - before[i].time_s;
    for (int k = i; k <= end; ++k) {
      const double share = lasts_s > 0.0 ? (before[k].time_s - before[i].time_s) / lasts_s : 1.0;
      wheels[k].*wheel += was + share * (is - was);
    }
    const int rested = rests_until(end);
    for (int k = end + 1; k <= rested; ++k) wheels[k].*wheel += is;
    was = is;
    i = rested + 1;
  }
}

// Turned a little further or less far: drives that are like each other end at places within a count that are, too.
void stand_further(std::vector<WheelSample>& wheels, double WheelSample::*wheel, Random& random) {
  constexpr double kMost = 0.03;
  const double further = 1.0 + random.uniform(-kMost, kMost), from = wheels.front().*wheel;
  for (WheelSample& w : wheels) w.*wheel = from + further * (w.*wheel - from);
}

void count_again(std::vector<WheelSample>& wheels, double WheelSample::*wheel, double count, Random& random) {
  const double from = random.uniform();
  for (WheelSample& w : wheels) w.*wheel = count * std::floor(w.*wheel / count + from);
}

// The truth where these wheels go, by the same steps as the filter's.
void follow(InnovationRun& run, const InnovationModel& model) {
  const SummedRun summed = summed_up(run, model);
  const TruthSample& first = run.truth.front();
  Pose axle = Pose{first.position.x_m, first.position.y_m, first.heading_rad.value_or(0.0)} *
              inverse(model.truth.axle_T_tracked);
  for (std::size_t t = 1; t < run.truth.size(); ++t) {
    axle = axle * summed.motions[t - 1].motion;
    const Pose tracked = axle * model.truth.axle_T_tracked;
    run.truth[t].position = tracked.position();
    if (run.truth[t].heading_rad) run.truth[t].heading_rad = tracked.heading_rad;
  }
}

// With everything of the run but its readings, which are those that were recorded, smoothed.
InnovationRun as_smoothed(const InnovationRun& run) {
  InnovationRun again = run.as_recorded ? *run.as_recorded : run;
  again.truth = run.truth;
  again.set_aside = run.set_aside;
  again.cut = run.cut;
  again.truth_variance = run.truth_variance;
  again.samples_averaged = run.samples_averaged;
  again.readings_averaged = run.readings_averaged;
  again.as_recorded.reset();
  if (!again.smooth.empty()) again.wheels = again.smooth;
  return again;
}

InnovationRun with_readings(InnovationRun again, std::vector<WheelSample> wheels) {
  const double longest_s = std::min(kReadingsApart_s, averaging_s(again));
  again.wheels = std::move(wheels);
  again.smooth = smoothed(again.wheels);
  again.accelerations = wheel_accelerations(again.wheels);
  return with_fewer_readings(again, longest_s);
}

InnovationRun counted(const InnovationRun& run, const InnovationModel& model, Where where, Random& random) {
  const double count = count_rad(run, model.drive);
  InnovationRun again = as_smoothed(run);
  if (count == 0.0 || again.smooth.empty()) return again;
  for (double WheelSample::*wheel : {&WheelSample::left_rad, &WheelSample::right_rad})
    if (where == Where::anywhere)
      stand_anywhere(again.wheels, wheel, count, random);
    else if (where == Where::further)
      stand_further(again.wheels, wheel, random);
  follow(again, model);
  std::vector<WheelSample> wheels = again.wheels;
  for (double WheelSample::*wheel : {&WheelSample::left_rad, &WheelSample::right_rad})
    count_again(wheels, wheel, count, random);
  return with_readings(std::move(again), with_slow_counts_drawn(wheels, count));
}

InnovationRun rolled(const InnovationRun& run, const InnovationModel& model, Random& random) {
  InnovationRun again = as_smoothed(run);
  follow(again, model);
  std::vector<WheelSample> wheels = again.wheels;
  const auto roll = [&](double WheelSample::*wheel, double radius_m) {
    double further_m = 0.0;
    for (std::size_t i = 1; i < wheels.size(); ++i) {
      const double way_m = radius_m * std::abs(again.wheels[i].*wheel - again.wheels[i - 1].*wheel);
      further_m += model.noise.wheel_m_per_sqrt_m * std::sqrt(way_m) * random.normal();
      wheels[i].*wheel += further_m / radius_m;
    }
  };
  roll(&WheelSample::left_rad, model.drive.wheel_radius_left_m);
  roll(&WheelSample::right_rad, model.drive.wheel_radius_right_m);
  return with_readings(std::move(again), std::move(wheels));
}

// The truth's headings, slowly off to one side and the other.
InnovationRun under_turned_truth(const InnovationRun& run, const InnovationModel& model, Random& random) {
  InnovationRun again = as_smoothed(run);
  std::vector<WheelSample> wheels = again.wheels;
  again = with_readings(std::move(again), std::move(wheels));
  follow(again, model);  // as the filter goes: what is left is the truth's turns and nothing else
  const double off_by_rad = truth_turned_rad(run, model.noise);
  double off_rad = off_by_rad * random.normal(), before_s = again.truth.front().time_s;
  for (TruthSample& t : again.truth) {
    const double keeps = std::exp(-(t.time_s - before_s) / kTurnedFor_s);
    off_rad = keeps * off_rad + std::sqrt(1.0 - keeps * keeps) * off_by_rad * random.normal();
    before_s = t.time_s;
    if (t.heading_rad) *t.heading_rad += off_rad;
  }
  return again;
}

// So many times the recordings, each driven again by `drive(run, k, random)`.
template <typename Drive>
std::vector<JointModel> driven(const JointModel& calibrated, int times, std::uint64_t first_seed, const Drive& drive) {
  std::vector<std::vector<InnovationRun>> runs(static_cast<std::size_t>(times));
  parallel_for(times, [&](int k) {
    for (std::size_t r = 0; r < calibrated.runs().size(); ++r) {
      Random random(seed_of_stream(first_seed + static_cast<std::uint64_t>(k), r));
      runs[static_cast<std::size_t>(k)].push_back(drive(static_cast<int>(r), k, random));
    }
  });
  std::vector<JointModel> again;
  for (std::vector<InnovationRun>& of : runs) again.push_back(calibrated.with_runs(std::move(of)));
  parallel_for(times, [&](int k) { again[static_cast<std::size_t>(k)].linearise(); });
  return again;
}

// The mean of so many squares, so many standard deviations off (Wilson, Hilferty, 1931).
double mean_of_squares(int n, double deviations) {
  const double spread = 2.0 / (9.0 * n);
  return std::pow(std::max(0.1, 1.0 - spread + deviations * std::sqrt(spread)), 3);
}

constexpr double kOnceInTwenty = 1.645, kOnceInAThousand = 3.09;  // standard deviations, to one side

struct Squares {
  double mean = 0.0;
  int numbers = 0;
};

Squares squares_of(const std::vector<JointModel>& again, const Effect& effect, const std::vector<double>& shape,
                   const AskedHow& how) {
  Squares all;
  for (const JointModel& joint : again) {
    CandidateColumns columns = joint.columns_of(effect, shape);
    columns.how = how;
    const CandidateTest of_readings = joint.test(columns);
    all.mean += of_readings.statistic;
    all.numbers += of_readings.freedom;
  }
  if (all.numbers > 0) all.mean /= all.numbers;
  return all;
}

}  // namespace

DrivenAgain::DrivenAgain(const JointModel& joint, bool counts_may_feign)
    : calibrated_(joint), counts_may_feign_(counts_may_feign) {
  calibrated_.accepted.clear();
  calibrated_.half_counts = {};
  calibrated_.driven_again.reset();
}

void DrivenAgain::drive() const {
  if (drives_) return;
  constexpr std::uint64_t kRolledFrom = 1000, kTurnedFrom = 2000;  // seeds of their own
  const std::vector<InnovationRun>& runs = calibrated_.runs();
  const auto run = [&](int r) -> const InnovationRun& { return runs[static_cast<std::size_t>(r)]; };
  drives_.emplace();
  if (counts_may_feign_)
    drives_->counted = driven(calibrated_, kCounted.of(calibrated_), 0, [&](int r, int k, Random& random) {
      return counted(run(r), calibrated_.model_of(r), static_cast<Where>(k % 3), random);
    });
  if (std::none_of(runs.begin(), runs.end(), std::mem_fn(&InnovationRun::speeds_are_held)))
    drives_->rolled = driven(calibrated_, kRolled.of(calibrated_), kRolledFrom, [&](int r, int, Random& random) {
      return rolled(run(r), calibrated_.model_of(r), random);
    });
  const bool frame_is_known_to_turn = calibrated_.model.noise.wander_lasts_s > 0.0;
  if (!frame_is_known_to_turn && std::any_of(runs.begin(), runs.end(), std::mem_fn(&InnovationRun::truth_has_heading)))
    drives_->turned = driven(calibrated_, kTurned.of(calibrated_), kTurnedFrom, [&](int r, int, Random& random) {
      return under_turned_truth(run(r), calibrated_.model_of(r), random);
    });
}

Feigned DrivenAgain::feigned(const Effect& effect, const std::vector<double>& shape, const FittedNoise& noise,
                             const AskedHow& how) const {
  drive();
  Feigned most;
  if (!effect.of_the_truth)
    if (const Squares of = squares_of(drives_->counted, effect, shape, how); of.numbers > 0)
      most = {std::max(0.0, of.mean / mean_of_squares(of.numbers, -kOnceInTwenty) - 1.0),
              static_cast<double>(of.numbers)};
  if (const Squares of = squares_of(drives_->rolled, effect, shape, how);
      of.numbers > 0 && of.mean > mean_of_squares(of.numbers, kOnceInAThousand)) {
    const double more =
        (of.mean - 1.0) * std::pow(noise.wheel_m_per_sqrt_m / calibrated_.model.noise.wheel_m_per_sqrt_m, 2);
    if (more > most.more) most.more = more;
  }
  constexpr double kLittle = 0.5;  // of what chance makes of each number
  if (const Squares of = squares_of(drives_->turned, effect, shape, how); of.numbers > 0 && of.mean > kLittle)
    most.more = std::max(most.more, of.mean);
  return most;
}

void widen_by_readings(CandidateTest& test, const JointModel& joint, const Effect& entry,
                       const std::vector<double>& shape) {
  if (joint.driven_again && !entry.local) test.widen(joint.driven_again->feigned(entry, shape, joint.model.noise));
}

}  // namespace odolab
