// Turn scrub: the effective wheelbase is b (1 + k |w|), so a turn falls short by k |w| / (1 + k |w|) of itself.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

std::vector<Effect> turn_scrub() {
  Effect e;
  e.name = "turn_scrub";
  e.component = "vehicle";
  e.amplitudes = {{"per_radps", "1/(rad/s)", 0.01, 0.0, 0.5}};
  e.shapes = {{"per_radps", "1/(rad/s)"}};  // the wheelbase grows: the turn is divided, which is not linear
  e.shape_follows_amplitude = true;
  e.forms = {"by the rate at which it does turn", "by the rate at which its wheels would turn it"};
  e.tests_of_a_shape = 0.5;  // a small scrub is the same in both
  e.scan = [](const std::vector<DriveView>&) { return std::vector<std::vector<double>>{{1e-4}}; };
  e.sentence = "the tyres scrub in turns: the effective wheelbase grows with the turn rate";
  e.regime = "in turns, grows with the turn rate";
  e.looks_like = {"tyre_compression", "speed_dependent_radius", "lateral_slip"};
  e.told_apart_by = "turns on the spot at two turn rates, and arcs of one radius at two speeds";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    const bool by_wheels = shape.back() == 1.0;
    Motions m;
    m.reserve(view.steps.size());
    const DifferentialDrive& d = view.drive;
    for (const EffectStep& s : view.steps) {
      const double of_wheels =
          std::abs((d.wheel_radius_right_m * s.right_radps - d.wheel_radius_left_m * s.left_radps) / d.wheelbase_m);
      // At which it does turn, r: r (1 + k r) is that of its wheels.
      const double does_turn = 2.0 * of_wheels / (1.0 + std::sqrt(1.0 + 4.0 * shape[0] * of_wheels));
      const double rate = by_wheels ? of_wheels : does_turn;
      m.push_back(BodyMotion{0.0, 0.0, -rate * s.turn_rad / (1.0 + shape[0] * rate)});
    }
    return motions_by_number(std::move(m));
  };
  return {e};
}

}  // namespace odolab::effects
