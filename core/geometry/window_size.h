// Over how much way and turn the errors of a track were gathered: a metre or a radian, or as much more as lies between
// two poses of the reference.
#pragma once

#include <vector>

#include "core/geometry/track.h"

namespace odolab {

struct WindowSize {
  double way_m = 0.0, turn_rad = 0.0;

  // Whether it is no longer true that errors are those of a metre or a radian.
  bool is_long() const { return way_m > 2.0 || turn_rad > 2.0; }
};

// Of each window of an error, by the estimate: a reference at both ends alone does not know its way.
std::vector<WindowSize> window_sizes(const Track& estimate, const TrackError& error);

// Way and turn each by itself; zero of none.
WindowSize median_of(const std::vector<WindowSize>& windows);

}  // namespace odolab
