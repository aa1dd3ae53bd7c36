// One wheel climbs something: it turns more than it travels, at one moment of one recording, or each time that it
// comes to one place on the floor.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

constexpr double kLength_m[3] = {0.06, 0.02, 0.2};  // of the way on which the extra distance is rolled
constexpr double kReach_m[3] = {0.1, 0.05, 0.2};    // from the place to where a wheel meets it

double way(Wheel wheel, const EffectStep& s) { return wheel == Wheel::left ? s.left_m : s.right_m; }

// Where the wheel stands.
Vec2 contact(Wheel wheel, const EffectStep& s, double wheelbase_m) {
  const double half = wheel == Wheel::left ? 0.5 * wheelbase_m : -0.5 * wheelbase_m;
  return {s.position.x_m - half * s.sin_heading, s.position.y_m + half * s.cos_heading};
}

// The extra distance, one metre of it, spread over the steps [from, to] as they are travelled.
void spread(Motions& m, const DriveView& view, Wheel wheel, std::size_t from, std::size_t to) {
  double total = 0.0;
  for (std::size_t i = from; i <= to; ++i) total += std::abs(way(wheel, view.steps[i]));
  if (total <= 0.01) return;
  for (std::size_t i = from; i <= to; ++i)
    m[i] = by_wheel(wheel, -way(wheel, view.steps[i]) / total, view.drive.wheelbase_m);
}

Motions at_moment(const DriveView& view, Wheel wheel, double at_s, double length_m) {
  const std::size_t middle = std::min(view.step_at(at_s), view.steps.size() - 1);
  std::size_t from = middle, to = middle;
  double before = 0.5 * std::abs(way(wheel, view.steps[middle])), behind = before;
  while (from > 0 && before < 0.5 * length_m && view.steps[middle].time_s - view.steps[from].time_s < 1.0)
    before += std::abs(way(wheel, view.steps[--from]));
  while (to + 1 < view.steps.size() && behind < 0.5 * length_m &&
         view.steps[to].time_s - view.steps[middle].time_s < 1.0)
    behind += std::abs(way(wheel, view.steps[++to]));
  Motions m(from, to + 1);
  spread(m, view, wheel, from, to);
  return m;
}

// Empty where the wheel never comes there.
Motions at_place(const DriveView& view, Wheel wheel, Vec2 place, double reach_m) {
  const double b = view.drive.wheelbase_m;
  std::vector<std::pair<std::size_t, std::size_t>> visits;  // first and last step of each
  view.steps_near(place, reach_m + 0.5 * b, [&](std::size_t i) {
    const Vec2 to = contact(wheel, view.steps[i], b) - place;
    if (dot(to, to) >= reach_m * reach_m) return;
    if (!visits.empty() && visits.back().second + 1 == i)
      visits.back().second = i;
    else
      visits.emplace_back(i, i);
  });
  if (visits.empty()) return {};
  Motions m(visits.front().first, visits.back().second + 1);
  for (const auto& [from, to] : visits) spread(m, view, wheel, from, to);
  return m;
}

Effect of_wheel(Wheel wheel) {
  Effect e;
  e.name = "bump";
  e.component = component_of(wheel);
  e.amplitudes = {{"extra_distance_m", "m", 0.005, 0.0, 0.3}};
  e.sentence = std::string("the ") + (wheel == Wheel::left ? "left" : "right") +
               " wheel climbs over something: it turns more than it travels";
  e.regime = "at one place";
  e.looks_like = {"collision", "slip_zone"};
  e.told_apart_by = "the same way driven again: a bump comes back at its place";
  e.local = true;
  return e;
}

Effect once(Wheel wheel) {
  Effect e = of_wheel(wheel);
  e.shapes = {{"recording", "1"}, {"at_s", "s"}};
  e.forms = {"over 6 cm of way", "over 2 cm", "over 20 cm"};
  e.of_one_recording = true;
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    if (view.number != static_cast<int>(shape[0])) return std::vector<Motions>{Motions()};
    return std::vector<Motions>{at_moment(view, wheel, shape[1], kLength_m[static_cast<int>(shape.back())])};
  };
  e.scan = [](const std::vector<DriveView>& views) {
    return moments(views, 0.15,
                   [](const EffectStep& s) { return std::abs(s.speed_mps) + std::abs(s.yaw_rate_radps) > 0.01; });
  };
  return e;
}

Effect each_time(Wheel wheel) {
  Effect e = of_wheel(wheel);
  e.shapes = {{"x_m", "m"}, {"y_m", "m"}};
  e.forms = {"within 10 cm", "within 5 cm", "within 20 cm"};
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    return std::vector<Motions>{at_place(view, wheel, {shape[0], shape[1]}, kReach_m[static_cast<int>(shape.back())])};
  };
  // It is met anywhere within reach, and no wheel comes to the same line twice.
  e.place_known_to_m = [](const std::vector<double>& shape) {
    return kReach_m[static_cast<int>(shape.back())] / std::sqrt(3.0);
  };
  // Only places to which the wheel came more than once: else it is a moment.
  e.scan = [wheel](const std::vector<DriveView>& views) {
    constexpr double kGrid_m = 0.1;
    std::set<std::pair<int, int>> seen, again;
    for (const DriveView& v : views) {
      std::pair<int, int> last{1 << 30, 0};
      for (const EffectStep& s : v.steps) {
        const Vec2 at = contact(wheel, s, v.drive.wheelbase_m);
        const std::pair<int, int> cell{static_cast<int>(std::lround(at.x_m / kGrid_m)),
                                       static_cast<int>(std::lround(at.y_m / kGrid_m))};
        if (cell == last) continue;
        last = cell;
        if (!seen.insert(cell).second) again.insert(cell);
      }
    }
    std::vector<std::vector<double>> shapes;
    const std::size_t stride = again.size() / 800 + 1;
    std::size_t i = 0;
    for (const auto& [x, y] : again)
      if (i++ % stride == 0) shapes.push_back({x * kGrid_m, y * kGrid_m});
    return shapes;
  };
  return e;
}

}  // namespace

std::vector<Effect> bump() {
  return {once(Wheel::left), once(Wheel::right), each_time(Wheel::left), each_time(Wheel::right)};
}

}  // namespace odolab::effects
