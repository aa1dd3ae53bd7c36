// Lateral slip: outwards, at a speed in proportion to the lateral acceleration v w.
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

std::vector<Effect> lateral_slip() {
  Effect e;
  e.name = "lateral_slip";
  e.component = "vehicle";
  e.amplitudes = {{"m_per_s_per_mps2", "s", 0.02, 0.0, 1.0}};
  e.sentence = "in bends the vehicle slips outwards, in proportion to its lateral acceleration";
  e.regime = "in arcs, grows with speed times turn rate";
  e.looks_like = {"truth_mounting_offset", "tyre_compression"};
  e.told_apart_by = "arcs at two speeds or more, and turns on the spot";
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps)
      m.push_back(BodyMotion{0.0, -s.speed_mps * s.yaw_rate_radps * s.duration_s, 0.0});
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
