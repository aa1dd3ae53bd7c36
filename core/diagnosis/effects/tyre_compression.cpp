// Tyre compression: with lateral acceleration a = v w the outer tyre is squeezed, and the inner one may be relieved.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {
BodyMotion outer_squeezed(const EffectStep& s, const DifferentialDrive& drive, bool inner_relieved) {
  const double a = s.speed_mps * s.yaw_rate_radps;  // to the left: then the right wheel is outside
  const double left_m = a < 0.0 || inner_relieved ? a * s.left_by_rad : 0.0;
  const double right_m = a > 0.0 || inner_relieved ? -a * s.right_by_rad : 0.0;
  return {0.5 * (left_m + right_m), 0.0, (right_m - left_m) / drive.wheelbase_m};
}
}  // namespace

std::vector<Effect> tyre_compression() {
  Effect e;
  e.name = "tyre_compression";
  e.component = "both_wheels";
  e.amplitudes = {{"radius_change_m_per_mps2", "m/(m/s2)", 0.0003, 0.0, 0.03}};
  e.forms = {"the outer tyre alone", "the outer tyre is squeezed and the inner one relieved"};
  e.sentence = "load transfer in bends squeezes the outer tyre";
  e.regime = "in arcs, grows with speed times turn rate";
  e.looks_like = {"turn_scrub", "lateral_slip", "speed_dependent_radius"};
  e.told_apart_by = "one radius at two speeds, one speed at two radii, and turns on the spot";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    for (const EffectStep& s : view.steps) m.push_back(outer_squeezed(s, view.drive, shape.back() > 0.5));
    return motions_by_number(std::move(m));
  };
  return {e};
}

}  // namespace odolab::effects
