#include "core/diagnosis/generic/lagging.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/counted.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/naming/late_wheel.h"

namespace odolab {

namespace {

std::vector<Motions> of_a_late_wheel(const DriveView& view, const std::vector<double>&) {
  return motions_by_number(of_older_counts(view));
}

std::vector<Motions> of_a_bending_mast(const DriveView& view, const std::vector<double>&) {
  const std::size_t n = view.steps.size();
  Motions ahead(n), aside(n);
  const auto lateral_mps2 = [](const EffectStep& s) { return s.speed_mps * s.yaw_rate_radps; };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const EffectStep &before = view.steps[i - 1], &behind = view.steps[i + 1];
    ahead[i].forward_m = 0.5 * (behind.acceleration_mps2 - before.acceleration_mps2);
    aside[i].sideways_m = 0.5 * (lateral_mps2(behind) - lateral_mps2(before));
  }
  return {ahead, aside};
}

// Each wheel falls behind its encoder as its drive is wound up by what it pushes.
std::vector<Motions> of_a_yielding_drive(const DriveView& view, const std::vector<double>&) {
  const std::size_t n = view.steps.size();
  Motions left(n), right(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const EffectStep &before = view.steps[i - 1], &behind = view.steps[i + 1];
    left[i] = by_wheel(Wheel::left, 0.5 * (before.left_mps2 - behind.left_mps2), view.drive.wheelbase_m);
    right[i] = by_wheel(Wheel::right, 0.5 * (before.right_mps2 - behind.right_mps2), view.drive.wheelbase_m);
  }
  return {left, right};
}

double longest_interval_s(const JointModel& joint) {
  double longest_s = 0.0;
  for (const InnovationRun& run : joint.runs())
    longest_s = std::max(
        longest_s, (run.wheels.back().time_s - run.wheels.front().time_s) / static_cast<double>(run.wheels.size() - 1));
  return longest_s;
}

// What wheels do between two readings nobody knows: by the square of that time a marker may seem to be ahead, or
// behind, of where it is for each of its acceleration, whichever way it is read.
void leave_to_intervals(GenericTest& t, const JointModel& joint) {
  const double longest_s = longest_interval_s(joint);
  for (CandidateTest* of : {&t.test, &t.instead})
    if (std::all_of(of->value.begin(), of->value.end(),
                    [&](double value) { return std::abs(value) < longest_s * longest_s; }))
      of->statistic = 0.0;
  t.p_value = t.p_value_of(t.test);
}

// A drive yields to what it pushes, and never the other way; and wheels that are thought to go evenly from one reading
// to the next are ahead of themselves by a twelfth of their acceleration times the square of that time, a quarter at
// most.
void leave_to_readings(GenericTest& t, const JointModel& joint) {
  constexpr double kAtMost = 0.25;
  const double longest_s = longest_interval_s(joint);
  for (CandidateTest* of : {&t.test, &t.instead})
    if (!of->value.empty() && *std::max_element(of->value.begin(), of->value.end()) < kAtMost * longest_s * longest_s)
      of->statistic = 0.0;
  t.p_value = t.p_value_of(t.test);
}

// A loop that asks one counter after the other reads one of them a little later.
void leave_to_the_loop(GenericTest& t) {
  for (CandidateTest* of : {&t.test, &t.instead})
    if (!of->value.empty() && std::abs(of->value.front()) < kLoopTakes_s) of->statistic = 0.0;
  t.p_value = t.p_value_of(t.test);
}

struct Lagging {
  const char *variable, *channel;
  std::size_t amplitudes;
  std::vector<Motions> (*motions)(const DriveView&, const std::vector<double>&);
};

constexpr Lagging kLagging[kLaggingTests] = {
    {"acceleration, as if it were read later", "way of the right wheel [s]", 1, of_a_late_wheel},
    {"acceleration, as if its mast bent", "marker, ahead and aside [s2]", 2, of_a_bending_mast},
    {"acceleration, as if its drive yielded", "way of the left and the right wheel [s2]", 2, of_a_yielding_drive},
};

}  // namespace

std::vector<GenericTest> lagging_tests(const AskedModel& asked, double looked_at) {
  std::vector<GenericTest> tests(kLaggingTests);
  parallel_for(kLaggingTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const Lagging& of = kLagging[i];
    t = asked_of(asked, of.variable, of.channel, of.amplitudes, of.motions, looked_at);
    leave_displaced_to_counting(t, asked.joint);
    if (of.motions == of_a_bending_mast) leave_to_intervals(t, asked.joint);
    if (of.motions == of_a_yielding_drive) leave_to_readings(t, asked.joint);
    if (of.motions == of_a_late_wheel) leave_to_the_loop(t);
  });
  return tests;
}

}  // namespace odolab
