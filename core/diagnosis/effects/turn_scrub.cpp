// Turn scrub: the effective wheelbase is b (1 + k |w|), so a turn falls short by k |w| of itself.
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
  e.scan = [](const std::vector<DriveView>&) { return std::vector<std::vector<double>>{{1e-4}}; };
  e.sentence = "the tyres scrub in turns: the effective wheelbase grows with the turn rate";
  e.regime = "in turns, grows with the turn rate";
  e.looks_like = {"tyre_compression", "speed_dependent_radius", "lateral_slip"};
  e.told_apart_by = "turns on the spot at two turn rates, and arcs of one radius at two speeds";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps) {
      const double rate = std::abs(s.yaw_rate_radps);  // at which it does turn, not that of its wheels
      m.push_back(BodyMotion{0.0, 0.0, -rate * s.turn_rad / (1.0 + shape[0] * rate)});
    }
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
