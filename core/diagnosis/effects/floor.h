// The floor on which the vehicle was seen: how far it reaches, and the points of a grid on it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

struct FloorSeen {
  Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
  double width_m() const { return high.x_m - low.x_m; }
  double height_m() const { return high.y_m - low.y_m; }
};

inline FloorSeen floor_of(const std::vector<DriveView>& views) {
  FloorSeen f;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps) {
      f.low = {std::min(f.low.x_m, s.position.x_m), std::min(f.low.y_m, s.position.y_m)};
      f.high = {std::max(f.high.x_m, s.position.x_m), std::max(f.high.y_m, s.position.y_m)};
    }
  return f;
}

// Calls `visit(x, y)` for each point of a grid, by its numbers along both axes, that lies nearer to a place than
// `within_m`.
template <typename Visit>
void grid_points_near(const Vec2& place, double stride_m, double within_m, Visit&& visit) {
  const auto first = [&](double m) { return static_cast<int>(std::ceil((m - within_m) / stride_m)); };
  const auto last = [&](double m) { return static_cast<int>(std::floor((m + within_m) / stride_m)); };
  for (int x = first(place.x_m); x <= last(place.x_m); ++x)
    for (int y = first(place.y_m); y <= last(place.y_m); ++y)
      if (length(Vec2{x * stride_m, y * stride_m} - place) < within_m) visit(x, y);
}

// As far each way as the floor reaches, so that what grows with the place is of one size along x and along y.
struct FloorSquare {
  Vec2 middle;
  double half_m = 0.0;
  // From the middle, as shares of half of it.
  Vec2 at(const Vec2& place) const { return (1.0 / half_m) * (place - middle); }
};

inline FloorSquare square_around(const FloorSeen& floor) {
  return {0.5 * (floor.low + floor.high), 0.5 * std::max(floor.width_m(), floor.height_m())};
}

}  // namespace odolab
