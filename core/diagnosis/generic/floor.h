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

}  // namespace odolab
