#include "core/diagnosis/generic/swaying_truth.h"

#include <algorithm>

#include "core/diagnosis/effects/effect_motions.h"

namespace odolab {

namespace {

// How far to either side a term carries the vehicle, along x or along y of the floor; nothing where it turns it.
std::optional<double> carries_to_either_side_m(const JointModel& joint, const Effect& term,
                                               const std::vector<double>& value) {
  double furthest_m = 0.0;
  for (const DriveView& view : joint.views()) {
    const Motions motion = motion_of(term, view, {}, value);
    Vec2 gone_m, low_m, high_m;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const BodyMotion m = motion.at(i);
      if (m.turn_rad != 0.0) return std::nullopt;
      gone_m = gone_m + Vec2{m.forward_m * s.cos_heading - m.sideways_m * s.sin_heading,
                             m.forward_m * s.sin_heading + m.sideways_m * s.cos_heading};
      low_m = {std::min(low_m.x_m, gone_m.x_m), std::min(low_m.y_m, gone_m.y_m)};
      high_m = {std::max(high_m.x_m, gone_m.x_m), std::max(high_m.y_m, gone_m.y_m)};
    }
    furthest_m = std::max({furthest_m, 0.5 * (high_m.x_m - low_m.x_m), 0.5 * (high_m.y_m - low_m.y_m)});
  }
  return furthest_m;
}

}  // namespace

void leave_to_swaying_truth(GenericTest& t, const JointModel& joint) {
  for (CandidateTest* of : {&t.test, &t.instead}) {
    if (of->value.empty() || t.p_value_of(*of) >= 1.0) continue;
    const std::optional<double> carries_m = carries_to_either_side_m(joint, *t.as_effect, of->value);
    if (!carries_m || *carries_m > joint.noise_as_recorded().truth_position_m) continue;
    if (of == &t.test) t.sway = {*carries_m, t.p_value_of(*of)};
    of->statistic = 0.0;
  }
  t.p_value = t.p_value_of(t.test);
}

}  // namespace odolab
