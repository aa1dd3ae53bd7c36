// A patch of floor on which wheels slip: there a wheel travels (1 - slip) of what it turns.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {
// A patch that a wheel does no more than graze is told from a bump by nothing.
constexpr double kLeastWay_m = 0.15;
}  // namespace

std::vector<Effect> slip_zone() {
  Effect e;
  e.name = "slip_zone";
  e.component = "floor";
  e.amplitudes = {{"slip", "1", 0.05, 0.0, 1.0}};
  e.shapes = {{"x_m", "m"}, {"y_m", "m"}, {"radius_m", "m", 0.0, 0.03, 20.0}};
  // A patch of three numbers is refined from a grid, from several starts: some two independent ones for each
  // scanned.
  e.tests_of_a_shape = 2.0;
  e.forms = {"each wheel that is on the patch", "both wheels while the axle's centre is on it",
             "travel alone while the axle's centre is on it"};
  e.sentence = "there is a patch of floor on which the wheels slip";
  e.regime = "on a patch of the floor";
  e.looks_like = {"bump", "collision"};
  e.told_apart_by = "the same patch crossed again on another line and at another speed";
  e.local = true;
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    const Vec2 centre{shape[0], shape[1]};
    const double b = view.drive.wheelbase_m, r2 = shape[2] * shape[2];
    std::vector<std::size_t> near;
    view.steps_near(centre, shape[2] + 0.5 * b, [&](std::size_t i) { near.push_back(i); });
    if (near.empty()) return std::vector<Motions>{Motions()};
    std::vector<Motions::Stretch> visits;
    for (const std::size_t i : near) {
      if (visits.empty() || visits.back().end != i) visits.push_back({i, i});
      visits.back().end = i + 1;
    }
    Motions m(std::move(visits));
    double left_way_m = 0.0, right_way_m = 0.0;  // on the patch
    for (const std::size_t i : near) {
      const EffectStep& s = view.steps[i];
      const Vec2 to = s.position - centre;
      const Vec2 side{-0.5 * b * s.sin_heading, 0.5 * b * s.cos_heading};
      const Vec2 left = to + side, right = to - side;
      if (shape.back() < 0.5) {
        const double l = dot(left, left) < r2 ? -s.left_m : 0.0, r = dot(right, right) < r2 ? -s.right_m : 0.0;
        left_way_m += std::abs(l);
        right_way_m += std::abs(r);
        m[i] = {0.5 * (l + r), 0.0, (r - l) / b};
      } else if (dot(to, to) < r2) {
        left_way_m += std::abs(s.left_m);
        right_way_m += std::abs(s.right_m);
        m[i] = {-s.forward_m(), 0.0, shape.back() < 1.5 ? -s.turn_rad : 0.0};
      }
    }
    if (std::max(left_way_m, right_way_m) < kLeastWay_m) return std::vector<Motions>{Motions()};
    return std::vector<Motions>{m};
  };
  e.scan = [](const std::vector<DriveView>& views) {
    double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
    for (const DriveView& v : views)
      for (const EffectStep& s : v.steps) {
        x0 = std::min(x0, s.position.x_m), x1 = std::max(x1, s.position.x_m);
        y0 = std::min(y0, s.position.y_m), y1 = std::max(y1, s.position.y_m);
      }
    std::vector<std::vector<double>> shapes;
    if (x1 < x0) return shapes;
    for (const auto& [radius, most] : {std::pair{0.25, 600.0}, {0.5, 200.0}, {0.9, 70.0}}) {
      const double stride = std::max(0.8 * radius, std::sqrt((x1 - x0 + 0.1) * (y1 - y0 + 0.1) / most));
      for (double x = x0; x <= x1 + 0.5 * stride; x += stride)
        for (double y = y0; y <= y1 + 0.5 * stride; y += stride) {
          bool visited = false;
          for (const DriveView& v : views) {
            const double reach_m = radius + 0.5 * v.drive.wheelbase_m;
            for (std::size_t i = 0; i < v.steps.size() && !visited; i += 10) {
              const Vec2 to = v.steps[i].position - Vec2{x, y};
              visited = dot(to, to) < reach_m * reach_m;
            }
            if (visited) break;
          }
          if (visited) shapes.push_back({x, y, radius});
        }
    }
    return shapes;
  };
  return {e};
}

}  // namespace odolab::effects
