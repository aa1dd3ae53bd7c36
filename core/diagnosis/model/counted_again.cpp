#include "core/diagnosis/model/counted_again.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/calibration/averaged_truth.h"
#include "core/calibration/fewer_readings.h"
#include "core/calibration/rests.h"
#include "core/calibration/slow_counts.h"
#include "core/calibration/smoothed_readings.h"

namespace odolab {

namespace {

// So often; a drive of hours, each of whose models is large, less often.
int times_of(const JointModel& joint) {
  constexpr std::size_t kMost = 20, kFewest = 6, kSamples = 400000;
  std::size_t samples = 1;
  for (const InnovationRun& run : joint.runs()) samples += run.truth.size();
  return static_cast<int>(std::clamp(kSamples / samples, kFewest, kMost));
}

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

InnovationRun counted_again(const InnovationRun& run, const InnovationModel& model, Where where, Random& random) {
  const double count = count_rad(run, model.drive);
  InnovationRun again = run.as_recorded ? *run.as_recorded : run;
  const double longest_s = std::min(kReadingsApart_s, averaging_s(again));
  again.truth = run.truth;
  again.set_aside = run.set_aside;
  again.cut = run.cut;
  again.truth_variance = run.truth_variance;
  again.samples_averaged = run.samples_averaged;
  again.readings_averaged = run.readings_averaged;
  again.as_recorded.reset();
  if (count == 0.0 || again.smooth.empty()) return again;
  again.wheels = again.smooth;
  for (double WheelSample::*wheel : {&WheelSample::left_rad, &WheelSample::right_rad})
    if (where == Where::anywhere)
      stand_anywhere(again.wheels, wheel, count, random);
    else if (where == Where::further)
      stand_further(again.wheels, wheel, random);
  follow(again, model);
  for (double WheelSample::*wheel : {&WheelSample::left_rad, &WheelSample::right_rad})
    count_again(again.wheels, wheel, count, random);
  again.wheels = with_slow_counts_drawn(again.wheels, count);
  again.smooth = smoothed(again.wheels);
  again.accelerations = wheel_accelerations(again.wheels);
  return with_fewer_readings(again, longest_s);
}

// Below which a mean of so many squares lies once in twenty times (Wilson, Hilferty, 1931).
double low_mean_of_squares(int n) {
  constexpr double kOnceInTwenty = 1.645;
  const double spread = 2.0 / (9.0 * n);
  return std::pow(std::max(0.1, 1.0 - spread - kOnceInTwenty * std::sqrt(spread)), 3);
}

}  // namespace

CountedAgain::CountedAgain(const JointModel& joint) {
  JointModel calibrated = joint;
  calibrated.accepted.clear();
  calibrated.half_counts = {};
  const int times = times_of(joint);
  std::vector<std::vector<InnovationRun>> runs(static_cast<std::size_t>(times));
  parallel_for(times, [&](int k) {
    for (std::size_t r = 0; r < joint.runs().size(); ++r) {
      Random random(seed_of_stream(static_cast<std::uint64_t>(k), r));
      runs[static_cast<std::size_t>(k)].push_back(
          counted_again(joint.runs()[r], calibrated.model_of(static_cast<int>(r)), static_cast<Where>(k % 3), random));
    }
  });
  for (std::vector<InnovationRun>& of : runs) again_.push_back(calibrated.with_runs(std::move(of)));
  parallel_for(times, [&](int k) { again_[static_cast<std::size_t>(k)].linearise(); });
}

Feigned CountedAgain::feigned(const Effect& effect, const std::vector<double>& shape, const AskedHow& how) const {
  double sum = 0.0;
  int numbers = 0;
  for (const JointModel& joint : again_) {
    CandidateColumns columns = joint.columns_of(effect, shape);
    columns.how = how;
    const CandidateTest of_rounding = joint.test(columns);
    sum += of_rounding.statistic;
    numbers += of_rounding.freedom;
  }
  if (numbers == 0) return {};
  return {std::max(0.0, sum / numbers / low_mean_of_squares(numbers) - 1.0), static_cast<double>(numbers)};
}

void widen_by_counts(CandidateTest& test, const JointModel& joint, const Effect& entry,
                     const std::vector<double>& shape) {
  if (joint.counted_again && !entry.local && !entry.of_the_truth)
    test.widen(joint.counted_again->feigned(entry, shape));
}

}  // namespace odolab
