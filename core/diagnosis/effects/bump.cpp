// One wheel climbs something: it turns more than it travels, within about a tenth of a metre of its way.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effect.h"

namespace odolab::effects {

namespace {
constexpr double kLength_m = 0.06;  // of the way on which the extra distance is rolled

Effect of_wheel(Wheel wheel) {
  Effect e;
  e.name = "bump";
  e.component = component_of(wheel);
  e.amplitudes = {{"extra_distance_m", "m", 0.005, 0.0, 0.3}};
  e.shapes = {{"recording", "1"}, {"at_s", "s"}};
  e.sentence = std::string("the ") + (wheel == Wheel::left ? "left" : "right") +
               " wheel climbs over something: it turns more than it travels";
  e.regime = "at one place";
  e.looks_like = {"collision", "slip_zone"};
  e.told_apart_by = "the same way driven again: a bump comes back at its place";
  e.local = true;
  e.of_one_recording = true;
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    Motions m(view.steps.size());
    if (view.number != static_cast<int>(shape[0])) return std::vector<Motions>{m};
    const auto way = [&](std::size_t i) {
      return std::abs(wheel == Wheel::left ? view.steps[i].left_m : view.steps[i].right_m);
    };
    std::size_t middle = 0;
    while (middle + 1 < view.steps.size() && view.steps[middle].time_s < shape[1]) ++middle;
    std::size_t from = middle, to = middle;  // [from, to]
    double before = 0.5 * way(middle), behind = before;
    while (from > 0 && before < 0.5 * kLength_m && view.steps[middle].time_s - view.steps[from].time_s < 1.0)
      before += way(--from);
    while (to + 1 < view.steps.size() && behind < 0.5 * kLength_m && view.steps[to].time_s - view.steps[middle].time_s < 1.0)
      behind += way(++to);
    double total = 0.0;
    for (std::size_t i = from; i <= to; ++i) total += way(i);
    if (total <= 0.01) return std::vector<Motions>{m};
    for (std::size_t i = from; i <= to; ++i) {
      const double d = wheel == Wheel::left ? view.steps[i].left_m : view.steps[i].right_m;
      m[i] = by_wheel(wheel, -d / total, view.drive.wheelbase_m);
    }
    return std::vector<Motions>{m};
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
        if ((rolled_m += 0.5 * (std::abs(s.left_m) + std::abs(s.right_m))) > 0.05 && s.time_s >= next && std::abs(s.speed_mps) + std::abs(s.yaw_rate_radps) > 0.01) {
          shapes.push_back({static_cast<double>(v.number), s.time_s});
          next = s.time_s + std::max(0.15, stride_s);
        }
    }
    return shapes;
  };
  return e;
}
}  // namespace

std::vector<Effect> bump() { return {of_wheel(Wheel::left), of_wheel(Wheel::right)}; }

}  // namespace odolab::effects
