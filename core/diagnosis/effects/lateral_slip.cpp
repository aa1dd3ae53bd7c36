// Lateral slip: outwards, at a speed in proportion to the lateral acceleration v w. A rubber tyre runs at a slip angle
// that is in proportion to it (Pacejka, Tyre and Vehicle Dynamics, ch. 1): its sideways speed then grows with the speed
// as well.
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

// At which slip at an angle is as large as slip that does not grow with the speed, by least squares.
double speed_of_bends_mps(const std::vector<DriveView>& views) {
  double squares = 0.0, by_speed = 1e-12;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps) {
      const double square = std::pow(s.speed_mps * s.yaw_rate_radps, 2) * s.duration_s;
      squares += square;
      by_speed += square * std::abs(s.speed_mps);
    }
  return squares > 0.0 ? by_speed / squares : 0.0;
}

}  // namespace

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
  e.stated_at_mps = [](const std::vector<double>& shape, const std::vector<DriveView>& views) {
    return shape.back() > 0.5 ? speed_of_bends_mps(views) : 0.0;
  };
  e.from_parameters = [](const ActiveEffect& a) {
    return std::vector<double>{a.parameter("m_per_s_per_mps2") / a.parameter(kStatedAt, 1.0)};
  };
  return {e};
}

}  // namespace odolab::effects
