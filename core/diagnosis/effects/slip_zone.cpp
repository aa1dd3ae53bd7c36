// A patch of floor on which wheels slip: there a wheel travels (1 - slip) of what it turns.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/floor.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {
// A patch that a wheel does no more than graze is told from a bump by nothing, nor is one that is smaller than the
// wheel.
constexpr double kLeastWay_m = 0.15;

// The points of a grid over the floor about which a patch of that radius would be met.
std::vector<Vec2> points_met(const std::vector<DriveView>& views, const FloorSeen& floor, double stride_m,
                             double radius_m) {
  const auto steps = [&](double m) { return static_cast<int>(m / stride_m + 0.5); };
  const int last_x = steps(floor.width_m()), last_y = steps(floor.height_m());
  using Cell = std::pair<int, int>;
  std::set<Cell> met;
  for (const DriveView& view : views) {
    const double reach_m = radius_m + 0.5 * view.drive.wheelbase_m;
    Vec2 last{1e9, 1e9};
    for (const EffectStep& s : view.steps) {
      if (length(s.position - last) < 0.1 * radius_m) continue;
      last = s.position;
      grid_points_near(s.position - floor.low, stride_m, reach_m, [&](int x, int y) {
        if (x >= 0 && x <= last_x && y >= 0 && y <= last_y) met.emplace(x, y);
      });
    }
  }
  std::vector<Vec2> points;
  for (const auto& [x, y] : met) points.push_back(floor.low + Vec2{x * stride_m, y * stride_m});
  return points;
}

// So many of each size at most, wherever the vehicle went: one run across a hall leaves the grid of the others as fine.
std::vector<std::vector<double>> patches_met(const std::vector<DriveView>& views) {
  const FloorSeen floor = floor_of(views);
  std::vector<std::vector<double>> patches;
  if (floor.width_m() < 0.0) return patches;
  for (const auto& [radius_m, most] : {std::pair{0.25, 600.0}, {0.5, 200.0}, {0.9, 70.0}}) {
    double stride_m = 0.8 * radius_m;
    std::vector<Vec2> points = points_met(views, floor, stride_m, radius_m);
    while (static_cast<double>(points.size()) > most) {
      stride_m *= std::max(1.05, std::sqrt(static_cast<double>(points.size()) / most));
      points = points_met(views, floor, stride_m, radius_m);
    }
    for (const Vec2& p : points) patches.push_back({p.x_m, p.y_m, radius_m});
  }
  return patches;
}

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
    if (shape[2] < kClimbedWithin * std::min(view.drive.wheel_radius_left_m, view.drive.wheel_radius_right_m))
      return motions_by_number(Motions());
    std::vector<std::size_t> near;
    view.steps_near(centre, shape[2] + 0.5 * b, [&](std::size_t i) { near.push_back(i); });
    if (near.empty()) return motions_by_number(Motions());
    std::vector<Motions::Stretch> visits;
    for (const std::size_t i : near) {
      if (visits.empty() || visits.back().end != i) visits.push_back({i, i});
      visits.back().end = i + 1;
    }
    Motions m(std::move(visits));
    double left_way_m = 0.0, right_way_m = 0.0;  // on the patch
    BodyMotion* at = m.from(near.front());       // steps that are near and what moves in them are in the same order
    for (const std::size_t i : near) {
      BodyMotion& moved = *at++;
      const EffectStep& s = view.steps[i];
      const Vec2 to = s.position - centre;
      const Vec2 side{-0.5 * b * s.sin_heading, 0.5 * b * s.cos_heading};
      const Vec2 left = to + side, right = to - side;
      if (shape.back() < 0.5) {
        const double l = dot(left, left) < r2 ? -s.left_m : 0.0, r = dot(right, right) < r2 ? -s.right_m : 0.0;
        left_way_m += std::abs(l);
        right_way_m += std::abs(r);
        moved = {0.5 * (l + r), 0.0, (r - l) / b};
      } else if (dot(to, to) < r2) {
        left_way_m += std::abs(s.left_m);
        right_way_m += std::abs(s.right_m);
        moved = {-s.forward_m(), 0.0, shape.back() < 1.5 ? -s.turn_rad : 0.0};
      }
    }
    if (std::max(left_way_m, right_way_m) < kLeastWay_m) return motions_by_number(Motions());
    return motions_by_number(std::move(m));
  };
  e.scan = patches_met;
  return {e};
}

}  // namespace odolab::effects
