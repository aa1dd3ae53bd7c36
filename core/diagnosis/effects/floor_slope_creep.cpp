// A steady creep in a fixed direction of the room.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

std::vector<Effect> floor_slope_creep() {
  Effect e;
  e.name = "floor_slope_creep";
  e.component = "floor";
  e.amplitudes = {{"x", "m/s", 0.001, -0.2, 0.2}, {"y", "m/s", 0.001, -0.2, 0.2}};
  e.forms = {"moving and at rest", "while a wheel turns"};
  e.tests_of_a_shape = 0.6;  // the same but for the rests
  e.sentence = "the vehicle creeps in one direction of the room, as on a slope";
  e.regime = "in a fixed direction of the room";
  e.looks_like = {"wheel_toe"};
  e.told_apart_by = "the same straight out and back, or along four headings";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    const bool at_rest_too = shape.back() < 0.5;
    const std::vector<char> turns = at_rest_too ? std::vector<char>(view.steps.size(), 1) : view.turning();
    Motions x, y;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const double dt = turns[i] ? s.duration_s : 0.0;
      const double c = s.cos_heading, sn = s.sin_heading;
      x.push_back({c * dt, -sn * dt, 0.0});
      y.push_back({sn * dt, c * dt, 0.0});
    }
    return motions_by_number(std::move(x), std::move(y));
  };
  e.to_parameters = [](const std::vector<double>& v, const std::vector<double>& se) {
    const double a = std::hypot(v[0], v[1]);
    return std::vector<FoundParameter>{
        {"direction_rad", std::atan2(v[1], v[0]), std::hypot(v[1] * se[0], v[0] * se[1]) / std::max(a * a, 1e-300),
         "rad"},
        {"creep_mps", a, std::hypot(v[0] * se[0], v[1] * se[1]) / std::max(a, 1e-300), "m/s"}};
  };
  e.from_parameters = [](const ActiveEffect& active) {
    const double a = active.parameter("creep_mps"), d = active.parameter("direction_rad");
    return std::vector<double>{a * std::cos(d), a * std::sin(d)};
  };
  return {e};
}

}  // namespace odolab::effects
