// Traction slip: the share of a step that is lost is in proportion to the acceleration along the travel.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

std::vector<Effect> traction_slip() {
  Effect e;
  e.name = "traction_slip";
  e.component = "both_wheels";
  e.amplitudes = {{"per_mps2", "1/(m/s2)", 0.01, 0.0, 0.3}};
  e.forms = {"each wheel by its own acceleration", "the vehicle by its acceleration"};
  e.sentence = "the wheels slip when they push: more turning than travel while accelerating, less while braking";
  e.regime = "while accelerating and braking";
  e.looks_like = {"clock_rate", "truth_time_offset", "drivetrain_backlash", "actuator_lag"};
  e.told_apart_by = "hard braking against hard accelerating, forwards and in reverse";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    const double b = view.drive.wheelbase_m;
    for (const EffectStep& step : view.steps) {
      if (shape.back() > 0.5) {
        m.push_back({-step.acceleration_mps2 * std::abs(step.forward_m()), 0.0, 0.0});
        continue;
      }
      const double left_m = -step.left_mps2 * std::abs(step.left_m),
                   right_m = -step.right_mps2 * std::abs(step.right_m);
      m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / b});
    }
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
