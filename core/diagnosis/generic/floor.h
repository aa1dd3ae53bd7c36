// How far the floor reaches on which the vehicle was seen.
#pragma once

#include <algorithm>
#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

struct Floor {
  Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
  double width_m() const { return high.x_m - low.x_m; }
  double height_m() const { return high.y_m - low.y_m; }
};

inline Floor floor_of(const std::vector<DriveView>& views) {
  Floor f;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps) {
      f.low = {std::min(f.low.x_m, s.position.x_m), std::min(f.low.y_m, s.position.y_m)};
      f.high = {std::max(f.high.x_m, s.position.x_m), std::max(f.high.y_m, s.position.y_m)};
    }
  return f;
}

// As far each way as the floor reaches, so that what grows with the place is of one size along x and along y.
struct FloorSquare {
  Vec2 middle;
  double half_m = 0.0;
  // From the middle, as shares of half of it.
  Vec2 at(const Vec2& place) const { return (1.0 / half_m) * (place - middle); }
};

inline FloorSquare square_around(const Floor& floor) {
  return {0.5 * (floor.low + floor.high), 0.5 * std::max(floor.width_m(), floor.height_m())};
}

}  // namespace odolab
