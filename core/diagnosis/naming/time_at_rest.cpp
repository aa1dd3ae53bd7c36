#include "core/diagnosis/naming/time_at_rest.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/model/candidate_scan.h"

namespace odolab {

namespace {

struct Rest {
  double from_s, to_s;
};

// Where neither wheel turns for a third of a second and more.
std::vector<Rest> rests(const DriveView& view) {
  constexpr double kLeast_s = 0.33;
  std::vector<Rest> found;
  for (std::size_t i = 0; i < view.steps.size();) {
    std::size_t j = i;
    while (j < view.steps.size() && view.steps[j].left_read_rad == 0.0 && view.steps[j].right_read_rad == 0.0) ++j;
    if (j > i) {
      const EffectStep &first = view.steps[i], &last = view.steps[j - 1];
      const Rest rest{first.time_s - 0.5 * first.duration_s, last.time_s + 0.5 * last.duration_s};
      if (rest.to_s - rest.from_s > kLeast_s) found.push_back(rest);
    }
    i = std::max(i + 1, j);
  }
  return found;
}

}  // namespace

UncertainTime time_with_rests(const JointModel& joint, int accepted, int entry, const UncertainTime& on_the_way,
                              double inflation) {
  constexpr double kOdds = 5.0;
  constexpr double kNear_s = 5.0;
  const AcceptedEffect& a = joint.accepted[static_cast<std::size_t>(accepted)];
  const CandidateScan scan(joint, accepted);
  const auto statistic_at = [&](double at_s) {
    std::vector<double> shape = a.shape;
    shape[static_cast<std::size_t>(entry)] = at_s;
    return scan.test(*a.effect, shape).statistic;
  };
  const double best = statistic_at(on_the_way.at_s), near_s = kNear_s + 4.0 * on_the_way.stderr_s;
  const double own = std::sqrt(2.0 * kPi) * on_the_way.stderr_s;
  double sum = own, later = 0.0, square = own * on_the_way.stderr_s * on_the_way.stderr_s;  // from that time on
  for (const DriveView& view : joint.views()) {
    if (a.effect->of_one_recording && view.number != static_cast<int>(a.shape[0])) continue;
    for (const Rest& rest : rests(view)) {
      if (rest.to_s < on_the_way.at_s - near_s || rest.from_s > on_the_way.at_s + near_s) continue;
      const double middle_s = 0.5 * (rest.from_s + rest.to_s), lasts_s = rest.to_s - rest.from_s;
      const double weight = kOdds * lasts_s * std::exp(0.5 * (statistic_at(middle_s) - best) / inflation);
      const double by_s = middle_s - on_the_way.at_s;
      sum += weight;
      later += weight * by_s;
      square += weight * (by_s * by_s + lasts_s * lasts_s / 12.0);
    }
  }
  later /= sum;
  return {on_the_way.at_s + later, std::sqrt(std::max(0.0, square / sum - later * later))};
}

}  // namespace odolab
