// Lateral slip: outwards, at a speed in proportion to the lateral acceleration v w. A rubber tyre runs at a slip angle
// that is in proportion to it (Pacejka, Tyre and Vehicle Dynamics, ch. 1): its sideways speed then grows with the speed
// as well.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

std::vector<Effect> lateral_slip() {
  Effect e;
  e.name = "lateral_slip";
  e.component = "vehicle";
  e.amplitudes = {{"m_per_s_per_mps2", "s", 0.02, 0.0, 0.5}};
  e.forms = {"at a speed in proportion to the lateral acceleration", "at an angle in proportion to it"};
  e.sentence = "in bends the vehicle slips outwards, in proportion to its lateral acceleration";
  e.regime = "in arcs, grows with speed times turn rate";
  e.looks_like = {"truth_mounting_offset", "tyre_compression"};
  e.told_apart_by = "arcs at two speeds or more, and turns on the spot";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps) {
      const double slip = -s.speed_mps * s.yaw_rate_radps * s.duration_s;
      m.push_back(BodyMotion{0.0, shape.back() > 0.5 ? slip * std::abs(s.speed_mps) : slip, 0.0});
    }
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
