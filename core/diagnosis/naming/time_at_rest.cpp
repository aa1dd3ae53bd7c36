#include "core/diagnosis/naming/time_at_rest.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/model/wheels_at_rest.h"

namespace odolab {

UncertainTime time_with_rests(const JointModel& joint, int accepted, int entry, const UncertainTime& summit,
                              double inflation) {
  constexpr double kOdds = 5.0, kLeastRest_s = 0.33;
  constexpr double kStep_s = 0.25, kMostSteps = 600.0;
  constexpr double kOfItsOwn = 2.0;  // standard errors about the summit that is known
  constexpr double kAsGood = 2.0;    // of twice the log-likelihood
  const AcceptedEffect& a = joint.accepted[static_cast<std::size_t>(accepted)];
  const auto at = static_cast<std::size_t>(entry);
  // A stretch of time each, with how likely it is beforehand.
  struct Slice {
    double middle_s, lasts_s, odds;
  };
  std::vector<Slice> slices;
  const bool begins_in_one = a.effect->of_one_recording || a.effect->and_later_recordings;
  // What comes in every recording counts from where each begins.
  const auto began_s = [&](const DriveView& view) {
    return begins_in_one ? 0.0 : effects::put_on_s(0.0, view.steps.front().time_s - view.steps.front().since_start_s);
  };
  std::vector<const DriveView*> views;
  double first_s = 1e300, last_s = -1e300;
  for (const DriveView& view : joint.views()) {
    if (view.steps.empty() || (begins_in_one && view.number != static_cast<int>(a.shape[0]))) continue;
    views.push_back(&view);
    first_s = std::min(first_s, view.steps.front().time_s - began_s(view));
    last_s = std::max(last_s, view.steps.back().time_s - began_s(view));
  }
  if (views.empty()) return summit;
  // Before the first step and behind the last all times are one: a summit there has no width of its own, and how far it
  // reaches inside the slices say.
  const double step_s = std::max(kStep_s, (last_s - first_s) / kMostSteps);
  const bool is_at_an_end = summit.at_s - summit.stderr_s < first_s || summit.at_s + summit.stderr_s > last_s;
  const UncertainTime on_the_way{std::clamp(summit.at_s, first_s, last_s),
                                 is_at_an_end ? std::min(step_s, summit.stderr_s) : summit.stderr_s};
  const double each = 1.0 / static_cast<double>(views.size());
  for (const DriveView* view : views) {
    double from_s = view->steps.front().time_s - began_s(*view);
    const auto drive_until = [&](double to_s) {
      for (; from_s < to_s; from_s += step_s) {
        const double lasts_s = std::min(step_s, to_s - from_s), middle_s = from_s + 0.5 * lasts_s;
        if (std::abs(middle_s - on_the_way.at_s) > kOfItsOwn * on_the_way.stderr_s)
          slices.push_back({middle_s, lasts_s, each});
      }
    };
    for (const Rest& rest : rests(*view)) {
      if (rest.lasts_s() <= kLeastRest_s) continue;
      const double rest_from_s = rest.from_s - began_s(*view), rest_to_s = rest.to_s - began_s(*view);
      drive_until(rest_from_s);
      slices.push_back({0.5 * (rest_from_s + rest_to_s), rest_to_s - rest_from_s, kOdds * each});
      from_s = rest_to_s;
    }
    drive_until(view->steps.back().time_s - began_s(*view));
  }
  std::vector<std::vector<double>> shapes(slices.size() + 1, a.shape);
  for (std::size_t k = 0; k < slices.size(); ++k) shapes[k][at] = slices[k].middle_s;
  shapes.back()[at] = on_the_way.at_s;
  const CandidateScan scan(joint, accepted);
  const std::vector<CandidateTest> tests = scan.tests(*a.effect, shapes);
  const double best = tests.back().statistic, own = std::sqrt(2.0 * kPi) * on_the_way.stderr_s;
  double sum = own, later = 0.0, square = own * on_the_way.stderr_s * on_the_way.stderr_s;  // from that time on
  for (std::size_t k = 0; k < slices.size(); ++k) {
    const double weight = slices[k].odds * slices[k].lasts_s * std::exp(0.5 * (tests[k].statistic - best) / inflation);
    const double by_s = slices[k].middle_s - on_the_way.at_s;
    sum += weight;
    later += weight * by_s;
    square += weight * (by_s * by_s + slices[k].lasts_s * slices[k].lasts_s / 12.0);
  }
  later /= sum;
  shapes.back()[at] += later;
  // Between two summits the mean is no time that it may have happened at.
  if (scan.test(*a.effect, shapes.back()).statistic < best - kAsGood * inflation)
    return {on_the_way.at_s, std::sqrt(square / sum)};
  return {on_the_way.at_s + later, std::sqrt(std::max(0.0, square / sum - later * later))};
}

}  // namespace odolab
