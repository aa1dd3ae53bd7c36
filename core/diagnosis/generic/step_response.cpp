#include "core/diagnosis/generic/step_response.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace odolab {

namespace {

// Where the hats stand, in seconds since the change: what follows at once is the clock's, and what stays for good,
// behind the last, the commands' scale.
constexpr double kSince_s[] = {0.04, 0.1, 0.17, 0.25, 0.35, 0.5, 0.7, 1.0};
constexpr std::size_t kHats = std::size(kSince_s) - 1;

// What may stay of it beside a lag: no loop is quite of the first order.
constexpr double kOfALag = 0.5;

double hat(std::size_t k, double since_s) {
  if (since_s < kSince_s[k == 0 ? 0 : k - 1] || since_s >= kSince_s[k + 1]) return 0.0;
  return since_s < kSince_s[k] ? (since_s - kSince_s[k - 1]) / (kSince_s[k] - kSince_s[k - 1])
                               : (kSince_s[k + 1] - since_s) / (kSince_s[k + 1] - kSince_s[k]);
}

std::vector<Motions> responses(const DriveView& view, const std::vector<double>&) {
  const std::vector<EffectStep>& steps = view.steps;
  std::vector<Motions> out(kHats, Motions(steps.size()));
  struct Change {
    double at_s, by_mps, by_radps;
  };
  constexpr double kChange = 1e-6;  // metres or radians per second; what is less is rounding
  std::vector<Change> changes;
  std::size_t oldest = 0;
  double speed_mps = 0.0, yaw_rate_radps = 0.0;  // it stands before it is told to go
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const EffectStep& s = steps[i];
    if (s.duration_s <= 0.0) continue;
    const double begins_s = s.time_s - 0.5 * s.duration_s;
    const double now_mps = s.forward_m() / s.duration_s, now_radps = s.turn_rad / s.duration_s;
    if (std::abs(now_mps - speed_mps) > kChange || std::abs(now_radps - yaw_rate_radps) > kChange)
      changes.push_back({begins_s, now_mps - speed_mps, now_radps - yaw_rate_radps});
    speed_mps = now_mps, yaw_rate_radps = now_radps;
    while (oldest < changes.size() && s.time_s - changes[oldest].at_s >= kSince_s[kHats]) ++oldest;
    for (std::size_t c = oldest; c < changes.size(); ++c)
      for (std::size_t k = 0; k < kHats; ++k) {
        const double by = s.duration_s * hat(k, s.time_s - changes[c].at_s);
        if (by == 0.0) continue;
        out[k][i].forward_m += by * changes[c].by_mps;
        out[k][i].turn_rad += by * changes[c].by_radps;
      }
  }
  return out;
}

// A base that acts on some changes sooner than on others takes them up bit by bit on the mean, and is behind its mean
// time for a while: that is known noise. It is never ahead of what it was told.
void leave_to_timing(GenericTest& t, const JointModel& joint) {
  constexpr double kAhead = 0.05, kStandardErrors = 4.0;
  constexpr double kAtOnce = 0.25;  // of the first hat's time: so little it takes up of none
  if (joint.model.noise.command_timing_s < kAtOnce * kSince_s[0]) return;
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
  GenericTest t;
  t.variable = "time since its command changed [s]";
  t.channel = "pace, as a share of the change [1]";
  t.most_left = kOfALag;
  t.at.assign(std::begin(kSince_s), std::end(kSince_s) - 1);
  auto term = std::make_shared<Effect>();
  term->name = t.variable;
  term->component = t.channel;
  term->amplitudes.resize(kHats);
  term->motions = responses;
  ask(t, asked, term, looked_at);
  leave_to_timing(t, asked.joint);
  return {std::move(t)};
}

}  // namespace odolab
