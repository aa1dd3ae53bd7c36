// Toe: the wheels point a little to one side of where the body does; to the left is positive, in reverse it turns
// round.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

std::vector<Effect> wheel_toe() {
  Effect e;
  e.name = "wheel_toe";
  e.component = "vehicle";
  e.amplitudes = {{"sideways_per_metre", "1", 0.005, -0.2, 0.2}};
  e.sentence = "the wheels do not stand square to the axle: the vehicle crawls sideways as it drives";
  e.regime = "wherever it drives, in proportion to the way";
  e.looks_like = {"one_sided_drag", "floor_slope_creep", "truth_mounting_offset"};
  e.told_apart_by = "the same straight forwards and in reverse";
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps) m.push_back(BodyMotion{0.0, s.forward_m(), 0.0});
    return motions_by_number(std::move(m));
  };
  return {e};
}

}  // namespace odolab::effects
