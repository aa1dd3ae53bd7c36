// One-sided drag: a turn per metre that keeps its side in reverse, unlike unequal wheels.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

std::vector<Effect> one_sided_drag() {
  Effect e;
  e.name = "one_sided_drag";
  e.component = "vehicle";
  e.amplitudes = {{"rad_per_m", "rad/m", 0.01, -1.0, 1.0}};
  e.sentence = "something drags on one side: the heading changes with the way driven, to the same side in reverse";
  e.regime = "wherever it drives, forwards and in reverse alike";
  e.looks_like = {"wheel_toe", "castor_reversal_kick", "radius_drift"};
  e.told_apart_by = "the same straight forwards and in reverse";
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps) m.push_back(BodyMotion{0.0, 0.0, std::abs(s.forward_m())});
    return motions_by_number(std::move(m));
  };
  return {e};
}

}  // namespace odolab::effects
