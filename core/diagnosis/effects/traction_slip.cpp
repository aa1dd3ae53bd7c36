// Traction slip: the share of a step that is lost is in proportion to the acceleration along the travel.
#include <cmath>
#include <string>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

Effect of_wheel(Wheel wheel) {
  Effect e;
  e.name = "traction_slip";
  e.component = component_of(wheel);
  e.amplitudes = {{"per_mps2", "1/(m/s2)", 0.01, 0.0, 0.3}};
  e.sentence = std::string(wheel == Wheel::both   ? "the wheels slip when they push"
                           : wheel == Wheel::left ? "the left wheel slips when it pushes"
                                                  : "the right wheel slips when it pushes") +
               ": more turning than travel while accelerating, less while braking";
  e.regime = "while accelerating and braking";
  e.looks_like = {"clock_rate", "truth_time_offset", "drivetrain_backlash", "actuator_lag"};
  e.told_apart_by = "hard braking against hard accelerating, forwards and in reverse";
  if (wheel == Wheel::both) e.forms = {"each wheel by its own acceleration", "the vehicle by its acceleration"};
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    const double b = view.drive.wheelbase_m;
    const bool as_one = wheel == Wheel::both && shape.back() > 0.5;
    for (const EffectStep& step : view.steps) {
      if (as_one) {
        m.push_back({-step.acceleration_mps2 * std::abs(step.forward_m()), 0.0, 0.0});
        continue;
      }
      const double left_m = wheel == Wheel::right ? 0.0 : -step.left_mps2 * std::abs(step.left_m);
      const double right_m = wheel == Wheel::left ? 0.0 : -step.right_mps2 * std::abs(step.right_m);
      m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / b});
    }
    return std::vector<Motions>{m};
  };
  return e;
}

}  // namespace

std::vector<Effect> traction_slip() { return {of_wheel(Wheel::both), of_wheel(Wheel::left), of_wheel(Wheel::right)}; }

}  // namespace odolab::effects
