// Where a wheel comes to rest and where it sets off again, as its readings show.
#pragma once

#include <vector>

#include "core/recording/recording.h"

namespace odolab {

constexpr double kRest_s = 0.2;  // a wheel that waits longer for its next count rests

// From one reading to the next, where a wheel's reading changed.
struct Movement {
  int interval = 0;         // between readings [interval] and [interval + 1]
  double by = 0.0;          // rad
  bool then_rests = false;  // before the next movement: it waits for longer, and not as it had to for the count before
                            // or behind in the same direction, which a wheel does that turns slowly
};
std::vector<Movement> movements(const std::vector<WheelSample>& readings, double WheelSample::*wheel);

struct RestEdge {
  int interval = 0;        // between readings [interval] and [interval + 1]: the last movement before, the first behind
  bool sets_off = false;   // else it stops
  double direction = 1.0;  // of the movement before the rest
};

// Of one wheel, in order. A slow wheel also waits for its next count, but not as long. The
// rest before the first movement has no edges.
std::vector<RestEdge> rest_edges(const std::vector<WheelSample>& readings, double WheelSample::*wheel);

}  // namespace odolab
