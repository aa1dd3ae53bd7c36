// Tyre compression: with lateral acceleration a = v w to the left the right tyre is squeezed, the left relieved.
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

namespace {
BodyMotion outer_squeezed(const EffectStep& s, const DifferentialDrive& drive) {
  const double a = s.speed_mps * s.yaw_rate_radps;
  const double left_m = a * s.left_by_rad, right_m = -a * s.right_by_rad;
  return {0.5 * (left_m + right_m), 0.0, (right_m - left_m) / drive.wheelbase_m};
}
}  // namespace

std::vector<Effect> tyre_compression() {
  Effect e;
  e.name = "tyre_compression";
  e.component = "both_wheels";
  e.amplitudes = {{"radius_change_m_per_mps2", "m/(m/s2)", 0.0003, -0.02, 0.02}};
  e.sentence = "load transfer in bends squeezes the outer tyre and relieves the inner one";
  e.regime = "in arcs, grows with speed times turn rate";
  e.looks_like = {"turn_scrub", "lateral_slip", "speed_dependent_radius"};
  e.told_apart_by = "one radius at two speeds, one speed at two radii, and turns on the spot";
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps) m.push_back(outer_squeezed(s, view.drive));
    return std::vector<Motions>{m};
  };
  return {e};
}

}  // namespace odolab::effects
