#include "core/diagnosis/generic/step_response.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/parallel.h"

namespace odolab {

namespace {

// Where the hats stand, in seconds since the change: what follows at once is the clock's, and what stays for good,
// behind the last, the commands' scale.
constexpr double kSinceStep_s[] = {0.04, 0.1, 0.17, 0.25, 0.35, 0.5, 0.7, 1.0};
constexpr std::size_t kHatsAfterStep = std::size(kSinceStep_s) - 1;

// What may stay of it beside a lag: no loop is quite of the first order.
constexpr double kOfALag = 0.5;

double hat(std::size_t k, double since_s) {
  if (since_s < kSinceStep_s[k == 0 ? 0 : k - 1] || since_s >= kSinceStep_s[k + 1]) return 0.0;
  return since_s < kSinceStep_s[k] ? (since_s - kSinceStep_s[k - 1]) / (kSinceStep_s[k] - kSinceStep_s[k - 1])
                                   : (kSinceStep_s[k + 1] - since_s) / (kSinceStep_s[k + 1] - kSinceStep_s[k]);
}

constexpr double kChange = 1e-6;  // metres or radians per second; what is less is rounding

// What follows changes of one motion that is told, in hats over the time since; of each change as much as `weight`
// says of it, by the speeds before and after.
template <typename WayOf, typename Weight, typename Add>
void add_responses(const std::vector<EffectStep>& steps, WayOf way_of, Weight weight, Add add) {
  struct Change {
    double at_s, by;
  };
  std::vector<Change> changes;
  std::size_t oldest = 0;
  double before = 0.0;  // it stands before it is told to go
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const EffectStep& s = steps[i];
    if (s.duration_s <= 0.0) continue;
    const double now = way_of(s) / s.duration_s;
    if (std::abs(now - before) > kChange)
      if (const double by = weight(before, now); by != 0.0) changes.push_back({s.time_s - 0.5 * s.duration_s, by});
    before = now;
    while (oldest < changes.size() && s.time_s - changes[oldest].at_s >= kSinceStep_s[kHatsAfterStep]) ++oldest;
    for (std::size_t c = oldest; c < changes.size(); ++c)
      for (std::size_t k = 0; k < kHatsAfterStep; ++k)
        if (const double by = s.duration_s * hat(k, s.time_s - changes[c].at_s); by != 0.0)
          add(k, i, by * changes[c].by);
  }
}

double change(double before, double now) { return now - before; }
double slowing(double before, double now) { return std::abs(now) < std::abs(before) ? now - before : 0.0; }
// In metres per second, for a wheel.
double larger(double before, double now) { return (now - before) * std::abs(now - before); }

std::vector<Motions> of_the_base(const DriveView& view, const std::vector<double>&) {
  std::vector<Motions> out(kHatsAfterStep, Motions(view.steps.size()));
  add_responses(
      view.steps, [](const EffectStep& s) { return s.told_forward_m(); }, change,
      [&](std::size_t k, std::size_t i, double by) { out[k][i].forward_m += by; });
  add_responses(
      view.steps, [](const EffectStep& s) { return s.told_turn_rad(); }, change,
      [&](std::size_t k, std::size_t i, double by) { out[k][i].turn_rad += by; });
  return out;
}

template <double (*weight)(double, double)>
std::vector<Motions> of_each_wheel(const DriveView& view, const std::vector<double>&) {
  std::vector<Motions> out(kHatsAfterStep, Motions(view.steps.size()));
  for (const Wheel wheel : {Wheel::left, Wheel::right})
    add_responses(
        view.steps, [&](const EffectStep& s) { return wheel == Wheel::left ? s.told_left_m() : s.told_right_m(); },
        weight,
        [&](std::size_t k, std::size_t i, double by) {
          const BodyMotion m = by_wheel(wheel, by, view.drive.wheelbase_m);
          out[k][i].forward_m += m.forward_m;
          out[k][i].turn_rad += m.turn_rad;
        });
  return out;
}

struct StepResponse {
  const char *variable, *channel;
  std::vector<Motions> (*motions)(const DriveView&, const std::vector<double>&);
};

constexpr StepResponse kStepResponses[kStepResponseTests] = {
    {"time since its command changed [s]", "pace, as a share of the change [1]", of_the_base},
    {"time since a wheel was told to go more slowly [s]", "its pace, as a share of the change [1]",
     of_each_wheel<slowing>},
    {"time since a wheel's command changed by more [s]", "its pace, as a share of the change for each m/s of it [s/m]",
     of_each_wheel<larger>},
};

// A base that acts on some changes sooner than on others takes them up bit by bit on the mean, and is behind its mean
// time for a while: that is known noise. It is never ahead of what it was told.
void leave_to_timing(GenericTest& t, const JointModel& joint) {
  constexpr double kAhead = 0.05, kStandardErrors = 4.0;
  constexpr double kAtOnce = 0.25;  // of the first hat's time: so little it takes up of none
  if (joint.model.noise.command_timing_s < kAtOnce * kSinceStep_s[0]) return;
  for (CandidateTest* of : {&t.test, &t.instead}) {
    bool is_ahead = false;
    for (std::size_t k = 0; k < of->value.size(); ++k)
      is_ahead =
          is_ahead || of->value[k] > std::max(kAhead, kStandardErrors * of->stderr_value[k] * std::sqrt(of->inflation));
    if (!is_ahead) of->statistic = 0.0;
  }
  t.p_value = t.p_value_of(t.test);
}

}  // namespace

std::vector<GenericTest> step_response_tests(const AskedModel& asked, double looked_at) {
  const std::vector<DriveView>& views = asked.joint.views();
  if (!std::all_of(views.begin(), views.end(), [](const DriveView& v) { return v.from_commands; })) return {};
  std::vector<GenericTest> tests(kStepResponseTests);
  parallel_for(kStepResponseTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t = asked_of(asked, kStepResponses[i].variable, kStepResponses[i].channel, kHatsAfterStep,
                 kStepResponses[i].motions, looked_at);
    t.most_left = kOfALag;
    t.at.assign(std::begin(kSinceStep_s), std::end(kSinceStep_s) - 1);
    if (i == 0) leave_to_timing(t, asked.joint);  // which takes up all changes alike
  });
  return tests;
}

}  // namespace odolab
