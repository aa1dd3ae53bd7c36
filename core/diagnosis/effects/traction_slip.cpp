// Traction slip: the share of a step that is lost is in proportion to the acceleration along the travel.
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

std::vector<Effect> traction_slip() {
  Effect e;
  e.name = "traction_slip";
  e.component = "both_wheels";
  e.amplitudes = {{"per_mps2", "1/(m/s2)", 0.01, 0.0, 1.0}};
  e.sentence = "the wheels slip when they push: more turning than travel while accelerating, less while braking";
  e.regime = "while accelerating and braking";
  e.looks_like = {"clock_rate", "truth_time_offset", "drivetrain_backlash", "actuator_lag"};
  e.told_apart_by = "hard braking against hard accelerating, forwards and in reverse";
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps) m.push_back(BodyMotion{-s.acceleration_mps2 * s.forward_m() * (s.speed_mps < 0.0 ? -1.0 : 1.0), 0.0, 0.0});
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
