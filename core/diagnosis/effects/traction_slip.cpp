// Traction slip: the share of a step that is lost is in proportion to the acceleration along the travel.
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

std::vector<Effect> traction_slip() {
  Effect e;
  e.name = "traction_slip";
  e.component = "both_wheels";
  e.amplitudes = {{"per_mps2", "1/(m/s2)", 0.01, 0.0, 1.0}};
  e.forms = {"each wheel by its own acceleration", "the vehicle by its acceleration"};
  e.sentence = "the wheels slip when they push: more turning than travel while accelerating, less while braking";
  e.regime = "while accelerating and braking";
  e.looks_like = {"clock_rate", "truth_time_offset", "drivetrain_backlash", "actuator_lag"};
  e.told_apart_by = "hard braking against hard accelerating, forwards and in reverse";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    // The way lost, the integral of |u| du = u |u| / 2, is the same however the speeds were smoothed.
    const auto energy = [](double u) { return 0.5 * u * std::abs(u); };
    const auto lost = [&](std::size_t i, auto speed_of) {
      const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, view.steps.size() - 1);
      if (after == before) return 0.0;
      return (energy(speed_of(view.steps[after])) - energy(speed_of(view.steps[before]))) /
             static_cast<double>(after - before);
    };
    const DifferentialDrive& drive = view.drive;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      if (shape.back() > 0.5) {
        m.push_back({-lost(i, [](const EffectStep& s) { return s.speed_mps; }), 0.0, 0.0});
        continue;
      }
      const double left_m = -lost(i, [&](const EffectStep& s) { return drive.wheel_radius_left_m * s.left_radps; });
      const double right_m = -lost(i, [&](const EffectStep& s) { return drive.wheel_radius_right_m * s.right_radps; });
      m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / drive.wheelbase_m});
    }
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
