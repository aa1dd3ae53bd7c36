// A heading kick each time that the direction of travel reverses, as the castors swing round.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

namespace {
// One kick at each reversal, spread over the castor's swing: its trail is about three centimetres.
Motions kicks(const DriveView& view) {
  constexpr double kSwing_m = 0.05;
  Motions m(view.steps.size());
  int direction = 0;
  double since_m = 1.0, sign = 0.0;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const double f = s.forward_m();
    // A turn on the spot is no travel.
    const bool travels = std::abs(s.speed_mps) > 0.005 && std::abs(s.speed_mps) > 0.02 * std::abs(s.yaw_rate_radps);
    if (travels && f != 0.0) {
      const int now = f > 0.0 ? 1 : -1;
      if (direction != 0 && now != direction) {
        since_m = 0.0;
        sign = now;
      }
      direction = now;
    }
    if (since_m < kSwing_m) {
      const double share = std::min(std::abs(f), kSwing_m - since_m) / kSwing_m;
      m[i].turn_rad = sign * share;
      since_m += std::abs(f);
    }
  }
  return m;
}
}  // namespace

std::vector<Effect> castor_reversal_kick() {
  Effect e;
  e.name = "castor_reversal_kick";
  e.component = "vehicle";
  e.amplitudes = {{"kick_rad", "rad", 0.01, -0.5, 0.5}};
  e.sentence = "when the direction of travel reverses, the castors swing round and kick the heading";
  e.regime = "where the direction of travel reverses";
  e.looks_like = {"drivetrain_backlash", "one_sided_drag"};
  e.told_apart_by = "a turn on the spot and then a straight, without reversing a wheel";
  e.motions = [](const DriveView& view, const std::vector<double>&) { return std::vector<Motions>{kicks(view)}; };
  return {e};
}

}  // namespace odolab::effects
