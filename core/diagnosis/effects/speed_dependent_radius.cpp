// The radius of both wheels grows by a share in proportion to the speed of the vehicle.
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

std::vector<Effect> speed_dependent_radius() {
  Effect e;
  e.name = "speed_dependent_radius";
  e.component = "both_wheels";
  e.amplitudes = {{"per_mps", "1/(m/s)", 0.02, -1.0, 1.0}};
  e.sentence = "the rolling radius changes with speed";
  e.regime = "grows with speed";
  e.looks_like = {"traction_slip", "turn_scrub", "tyre_compression"};
  e.told_apart_by = "the same straight at two speeds or more";
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps) m.push_back(BodyMotion{std::abs(s.speed_mps) * s.forward_m(), 0.0, std::abs(s.speed_mps) * s.turn_rad});
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
