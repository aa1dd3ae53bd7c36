// A push from outside: a step of the pose, in the frame of the vehicle, at one time of one recording.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

std::vector<Effect> collision() {
  Effect e;
  e.name = "collision";
  e.component = "vehicle";
  e.amplitudes = {{"dx_m", "m", 0.02, -2.0, 2.0}, {"dy_m", "m", 0.02, -2.0, 2.0}, {"dheading_rad", "rad", 0.03, -4.0, 4.0}};
  e.shapes = {{"recording", "1"}, {"at_s", "s"}};
  e.sentence = "something pushed the vehicle: its pose jumps while the wheels know nothing of it";
  e.regime = "at one moment";
  e.looks_like = {"bump", "truth_frozen"};
  e.told_apart_by = "the same way driven again: a push does not come back";
  e.local = true;
  e.of_one_recording = true;
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    std::vector<Motions> m(3, Motions(view.steps.size()));
    if (view.number != static_cast<int>(shape[0])) return m;
    for (std::size_t i = 0; i < view.steps.size(); ++i)
      if (std::abs(view.steps[i].time_s - shape[1]) <= 0.5 * view.steps[i].duration_s + 1e-9) {
        m[0][i].forward_m = 1.0;
        m[1][i].sideways_m = 1.0;
        m[2][i].turn_rad = 1.0;
        break;
      }
    return m;
  };
  e.scan = [](const std::vector<DriveView>& views) {
    std::vector<std::vector<double>> shapes;
    double span_s = 0.0;
    for (const DriveView& v : views)
      if (!v.steps.empty()) span_s += v.steps.back().time_s - v.steps.front().time_s;
    const double stride_s = span_s / 2500.0;  // long recordings are scanned more coarsely
    for (const DriveView& v : views) {
      double next = -1e300, rolled_m = 0.0;
      for (const EffectStep& s : v.steps)
        // The first centimetres take up whatever play there is, and are no push.
        if ((rolled_m += 0.5 * (std::abs(s.left_m) + std::abs(s.right_m))) > 0.05 && s.time_s >= next) {
          shapes.push_back({static_cast<double>(v.number), s.time_s});
          next = s.time_s + std::max(0.12, stride_s);
        }
    }
    return shapes;
  };
  return {e};
}

}  // namespace odolab::effects
