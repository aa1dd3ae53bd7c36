// Loss of speed in turns: the share of the forward motion that is lost is k |w|.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

std::vector<Effect> turn_speed_loss() {
  Effect e;
  e.name = "turn_speed_loss";
  e.component = "vehicle";
  e.amplitudes = {{"per_radps", "1/(rad/s)", 0.02, 0.0, 3.0}};
  e.sentence = "the base loses forward speed while it turns, in proportion to the turn rate";
  e.regime = "in arcs";
  e.looks_like = {"turn_scrub", "tyre_compression", "speed_dependent_radius"};
  e.told_apart_by = "arcs of two radii at one speed, beside straights";
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps)
      m.push_back(BodyMotion{-std::abs(s.yaw_rate_radps) * s.forward_m(), 0.0, 0.0});
    return motions_by_number(std::move(m));
  };
  return {e};
}

}  // namespace odolab::effects
