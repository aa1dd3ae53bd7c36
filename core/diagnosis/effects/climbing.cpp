#include "core/diagnosis/effects/climbing.h"

#include <algorithm>
#include <cmath>

namespace odolab::effects {

namespace {

// In order and apart: what overlaps or touches is one.
std::vector<Motions::Stretch> merged(std::vector<Motions::Stretch> stretches) {
  std::sort(stretches.begin(), stretches.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Motions::Stretch> out;
  for (const Motions::Stretch& s : stretches)
    if (out.empty() || s.first > out.back().end)
      out.push_back(s);
    else
      out.back().end = std::max(out.back().end, s.end);
  return out;
}

}  // namespace

Effect bump_of(Wheel wheel) {
  Effect e;
  e.name = "bump";
  e.component = component_of(wheel);
  e.amplitudes = {{"extra_distance_m", "m", 0.005, 0.0, 0.3}};
  e.sentence = std::string(wheel == Wheel::left    ? "the left wheel"
                           : wheel == Wheel::right ? "the right wheel"
                                                   : "whichever wheel comes there") +
               " climbs over something: it turns more than it travels";
  e.regime = "at one place";
  e.looks_like = {"collision", "slip_zone"};
  e.told_apart_by = "the same way driven again: a bump comes back at its place";
  e.local = true;
  return e;
}

bool is_climbed(double extra_m, const Climb& climb) {
  constexpr double kSteepest = 2.0 / 3.0;
  return climb.evenly_over_m == 0.0 || extra_m <= kSteepest * climb.evenly_over_m;
}

double radius_m(Wheel wheel, const DriveView& view) {
  return wheel == Wheel::left ? view.drive.wheel_radius_left_m : view.drive.wheel_radius_right_m;
}

Steps steps_about(const DriveView& view, Wheel wheel, std::size_t middle, double length_m) {
  const double at_s = view.steps[middle].time_s;
  Steps s{middle, middle};
  double before = 0.5 * std::abs(way_of(view.steps[middle], wheel)), behind = before;
  while (s.first > 0 && before < 0.5 * length_m && at_s - view.steps[s.first].time_s < kLongestBump_s)
    before += std::abs(way_of(view.steps[--s.first], wheel));
  while (s.last + 1 < view.steps.size() && behind < 0.5 * length_m && view.steps[s.last].time_s - at_s < kLongestBump_s)
    behind += std::abs(way_of(view.steps[++s.last], wheel));
  return s;
}

void spread(Motions& m, const DriveView& view, const Climbing& climbing, const Climb& climb, double across_m) {
  const auto& [wheel, over] = climbing;
  double total = 0.0;
  for (std::size_t i = over.first; i <= over.last; ++i) total += std::abs(way_of(view.steps[i], wheel));
  if (total <= 0.01) return;
  const double extra_m = across_m > 0.0 ? total / across_m : 1.0;
  double gone = 0.0, before = 0.0;
  BodyMotion* at = m.from(over.first);
  for (std::size_t i = over.first; i <= over.last; ++i, ++at) {
    const double goes = way_of(view.steps[i], wheel);
    gone = std::min(gone + std::abs(goes) / total, 1.0);
    const double now = climb.share_before(gone);
    const BodyMotion by = by_wheel(wheel, std::copysign(extra_m * (now - before), -goes), view.drive.wheelbase_m);
    at->forward_m += by.forward_m;
    at->turn_rad += by.turn_rad;
    before = now;
  }
}

Motions motions_of(const DriveView& view, const std::vector<Climbing>& climbs, const Climb& climb, double across_m) {
  if (climbs.empty()) return {};
  std::vector<Motions::Stretch> stretches;
  for (const Climbing& c : climbs) stretches.push_back({c.over.first, c.over.last + 1});
  Motions m(merged(std::move(stretches)));
  for (const Climbing& c : climbs) spread(m, view, c, climb, across_m);
  return m;
}

}  // namespace odolab::effects
