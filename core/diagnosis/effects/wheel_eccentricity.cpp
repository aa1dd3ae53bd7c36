// Once-per-turn error: the rolled distance is (1 + amplitude sin(rotation + phase)) of the even one.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

namespace {
Effect of_wheel(Wheel wheel) {
  Effect e;
  e.name = "wheel_eccentricity";
  e.component = component_of(wheel);
  e.amplitudes = {{"sine", "1", 0.005, -0.2, 0.2}, {"cosine", "1", 0.005, -0.2, 0.2}};
  e.sentence = std::string("the ") + (wheel == Wheel::left ? "left" : "right") +
               " wheel, or its encoder, runs out of round: it errs once per turn";
  e.regime = "once per turn of the wheel";
  e.looks_like = {"wheel_eccentricity"};
  e.told_apart_by = "arcs, which shift the phase of one wheel against the other";
  e.motions = [wheel](const DriveView& view, const std::vector<double>&) {
    Motions sine, cosine;
    for (const EffectStep& s : view.steps) {
      const double phi = wheel == Wheel::left ? s.left_rad : s.right_rad;
      const double d = wheel == Wheel::left ? s.left_m : s.right_m;
      sine.push_back(by_wheel(wheel, d * std::sin(phi), view.drive.wheelbase_m));
      cosine.push_back(by_wheel(wheel, d * std::cos(phi), view.drive.wheelbase_m));
    }
    return std::vector<Motions>{sine, cosine};
  };
  e.to_parameters = [](const std::vector<double>& v, const std::vector<double>& se) {
    const double a = std::hypot(v[0], v[1]);
    const double sa = std::hypot(v[0] * se[0], v[1] * se[1]) / std::max(a, 1e-300);
    const double sp = std::hypot(v[1] * se[0], v[0] * se[1]) / std::max(a * a, 1e-300);
    return std::vector<FoundParameter>{{"amplitude", a, sa, "1"}, {"phase_rad", std::atan2(v[1], v[0]), sp, "rad"}};
  };
  e.from_parameters = [](const ActiveEffect& active) {
    const double a = active.parameter("amplitude"), p = active.parameter("phase_rad");
    return std::vector<double>{a * std::cos(p), a * std::sin(p)};
  };
  return e;
}
}  // namespace

std::vector<Effect> wheel_eccentricity() { return {of_wheel(Wheel::left), of_wheel(Wheel::right)}; }

}  // namespace odolab::effects
