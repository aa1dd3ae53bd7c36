// Wheels that grow or shrink with time: warming, wear, pressure. The share of the radius is per_s times the time.
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

namespace {
Effect of_wheel(Wheel wheel) {
  Effect e;
  e.name = "radius_drift";
  e.component = component_of(wheel);
  e.amplitudes = {{"per_s", "1/s", 1e-4, -0.01, 0.01}};
  e.sentence = std::string("the radius of the ") +
               (wheel == Wheel::left    ? "left wheel"
                : wheel == Wheel::right ? "right wheel"
                                        : "wheels") +
               " drifts with time";
  e.regime = "grows with the time since the start";
  e.looks_like = {"one_sided_drag", "payload_radius_change", "clock_rate"};
  e.told_apart_by = "the same straight early and late in a long run";
  e.motions = [wheel](const DriveView& view, const std::vector<double>&) {
    Motions m;
    for (const EffectStep& s : view.steps) {
      const double t = s.since_start_s;
      if (wheel == Wheel::both)
        m.push_back({t * s.forward_m(), 0.0, t * s.turn_rad});
      else
        m.push_back(by_wheel(wheel, t * (wheel == Wheel::left ? s.left_m : s.right_m), view.drive.wheelbase_m));
    }
    return std::vector<Motions>{m};
  };
  return e;
}
}  // namespace

std::vector<Effect> radius_drift() { return {of_wheel(Wheel::both), of_wheel(Wheel::left), of_wheel(Wheel::right)}; }

}  // namespace odolab::effects
