// Above a wheel speed a share of the counts is lost: the wheel turns further than its encoder says.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {
Effect of_wheel(Wheel wheel) {
  Effect e;
  e.name = "encoder_missed_counts";
  e.component = component_of(wheel);
  e.amplitudes = {{"fraction", "1", 0.01, 0.0, 1.0}};
  e.shapes = {{"above_radps", "rad/s", 0.0, 0.0, 1e3}};
  e.sentence = std::string("the encoder of ") +
               (wheel == Wheel::left    ? "the left wheel"
                : wheel == Wheel::right ? "the right wheel"
                                        : "both wheels") +
               " misses a share of its counts above a speed";
  e.regime = "above a wheel speed";
  e.looks_like = {"speed_dependent_radius", "turn_scrub"};
  e.told_apart_by = "straights and turns at three speeds, each held for a few metres";
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    for (const EffectStep& s : view.steps) {
      const double l = std::abs(s.left_radps) > shape[0] ? s.left_m : 0.0;
      const double r = std::abs(s.right_radps) > shape[0] ? s.right_m : 0.0;
      if (wheel == Wheel::both)
        m.push_back({0.5 * (l + r), 0.0, (r - l) / view.drive.wheelbase_m});
      else
        m.push_back(by_wheel(wheel, wheel == Wheel::left ? l : r, view.drive.wheelbase_m));
    }
    return std::vector<Motions>{m};
  };
  e.scan = [](const std::vector<DriveView>& views) {
    double most = 0.0;
    for (const DriveView& v : views)
      for (const EffectStep& s : v.steps) most = std::max({most, std::abs(s.left_radps), std::abs(s.right_radps)});
    std::vector<std::vector<double>> shapes;
    for (int k = 2; k < 12; ++k) shapes.push_back({most * k / 12.0});
    return shapes;
  };
  return e;
}
}  // namespace

std::vector<Effect> encoder_missed_counts() {
  return {of_wheel(Wheel::left), of_wheel(Wheel::right), of_wheel(Wheel::both)};
}

}  // namespace odolab::effects
