// A load that is put on or off squeezes the wheels: a step of both radii, in shares of them, at a time of one recording.
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

std::vector<Effect> payload_radius_change() {
  Effect e;
  e.name = "payload_radius_change";
  e.component = "both_wheels";
  e.amplitudes = {{"left", "1", 0.004, -0.25, 0.25}, {"right", "1", 0.004, -0.25, 0.25}};
  e.shapes = {{"recording", "1"}, {"at_s", "s"}};
  e.sentence = "the wheel radii step at one time, as when a load is put on or off";
  e.regime = "from one time on";
  e.looks_like = {"radius_drift"};
  e.told_apart_by = "a longer run, with the same straight several times";
  e.of_one_recording = true;
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    Motions left(view.steps.size()), right(view.steps.size());
    if (view.number == static_cast<int>(shape[0]))
      for (std::size_t i = 0; i < view.steps.size(); ++i) {
        const EffectStep& s = view.steps[i];
        if (s.time_s < shape[1]) continue;
        left[i] = by_wheel(Wheel::left, view.drive.wheel_radius_left_m * s.left_by_rad, view.drive.wheelbase_m);
        right[i] = by_wheel(Wheel::right, view.drive.wheel_radius_right_m * s.right_by_rad, view.drive.wheelbase_m);
      }
    return std::vector<Motions>{left, right};
  };
  e.scan = [](const std::vector<DriveView>& views) {
    std::vector<std::vector<double>> shapes;
    for (const DriveView& v : views) {
      if (v.steps.empty()) continue;
      const double from = v.steps.front().time_s, span = v.steps.back().time_s - from;
      for (int k = 1; k < 12; ++k) shapes.push_back({static_cast<double>(v.number), from + span * k / 12.0});
    }
    return shapes;
  };
  return {e};
}

}  // namespace odolab::effects
