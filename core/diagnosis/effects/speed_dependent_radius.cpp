// The radius of both wheels grows by a share in proportion to the speed of the vehicle.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

std::vector<Effect> speed_dependent_radius() {
  Effect e;
  e.name = "speed_dependent_radius";
  e.component = "both_wheels";
  e.amplitudes = {{"per_mps", "1/(m/s)", 0.02, -0.3, 0.3}};
  e.forms = {"with each wheel's own speed", "with the vehicle's speed"};
  e.sentence = "the rolling radius changes with speed";
  e.regime = "grows with speed";
  e.looks_like = {"traction_slip", "turn_scrub", "tyre_compression"};
  e.told_apart_by = "the same straight at two speeds or more";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    const DifferentialDrive& drive = view.drive;
    for (const EffectStep& s : view.steps) {
      const double v = std::abs(s.speed_mps);
      const bool own = shape.back() < 0.5;
      const double left_m = s.left_m * (own ? drive.wheel_radius_left_m * std::abs(s.left_radps) : v);
      const double right_m = s.right_m * (own ? drive.wheel_radius_right_m * std::abs(s.right_radps) : v);
      m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / drive.wheelbase_m});
    }
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
