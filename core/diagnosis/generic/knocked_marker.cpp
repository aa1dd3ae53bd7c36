#include "core/diagnosis/generic/knocked_marker.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

namespace {

// By a metre ahead, a metre to the left, and turned by a radian; shape {recording, at_s}.
Effect sits_elsewhere_since() {
  Effect e;
  e.name = "sits_elsewhere_since";
  e.component = "truth";
  e.amplitudes = {{"ahead_m", "m"}, {"left_m", "m"}, {"heading_rad", "rad"}};
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    const std::size_t n = view.steps.size();
    if (view.number != static_cast<int>(shape[0])) return std::vector<Motions>(3);
    const std::size_t at = view.step_at(shape[1]);
    if (at >= n) return std::vector<Motions>(3);
    Motions ahead(at, n), left(at, n), turned(at, n);
    ahead[at].forward_m = left[at].sideways_m = turned[at].turn_rad = 1.0;
    for (std::size_t i = at + 1; i < n; ++i) {
      const EffectStep& s = view.steps[i];
      ahead[i].sideways_m = s.turn_rad;
      left[i].forward_m = -s.turn_rad;
      turned[i].sideways_m = -s.forward_m();  // it goes where it went before, and says another heading
    }
    return motions_by_number(std::move(ahead), std::move(left), std::move(turned));
  };
  return e;
}

}  // namespace

std::optional<Unnamed> what_sits_elsewhere_since(const JointModel& joint,
                                                 const std::vector<ScoredCandidate>& evidence) {
  static const Effect elsewhere = sits_elsewhere_since();
  constexpr double kAbout_s[] = {-0.2, -0.1, 0.0, 0.1, 0.2};
  std::optional<Unnamed> most;
  for (std::size_t k = 0; k < joint.accepted.size() && k < evidence.size(); ++k) {
    const AcceptedEffect& a = joint.accepted[k];
    if (!a.effect->local || !a.effect->of_one_recording) continue;
    const CandidateScan scan(joint, static_cast<int>(k));
    CandidateTest best;
    double at_s = 0.0;
    for (const double about_s : kAbout_s) {
      const double tried_s = a.shape[1] + about_s;
      if (CandidateTest test = scan.test(elsewhere, {a.shape[0], tried_s}); test.statistic > best.statistic)
        best = std::move(test), at_s = tried_s;
    }
    const double own = evidence[k].test.statistic, inflation = std::max(1.0, evidence[k].test.inflation);
    const double clearly = kClearlyBeaten + 2.0 * std::log(static_cast<double>(std::size(kAbout_s)));
    if (best.statistic < own + inflation * clearly || (most && best.statistic < most->gain)) continue;
    Unnamed u;
    u.component = "truth";
    u.gain = best.statistic;
    u.p_value = evidence[k].p_value;  // it says more
    u.where.recording = joint.runs()[static_cast<std::size_t>(a.shape[0])].name;
    u.where.time_s = {{at_s, at_s}};
    u.where.regime = formatted(
        "the tracked point sits elsewhere on the vehicle from %.1f s on, %.1f mm further %s and %.1f mm to the %s, as "
        "where a marker is knocked or slips",
        at_s, 1e3 * std::abs(best.value[0]), best.value[0] < 0.0 ? "back" : "ahead", 1e3 * std::abs(best.value[1]),
        best.value[1] < 0.0 ? "right" : "left");
    most = std::move(u);
  }
  return most;
}

}  // namespace odolab
