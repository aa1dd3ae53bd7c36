// A recording whose truth is told in another room's coordinates.
#pragma once

#include <utility>
#include <vector>

#include "core/recording/recording.h"

namespace odolab::test {

// `room`: where this one's origin stands in the other.
inline Recording in_room(Recording r, const Pose& room) {
  std::vector<double>*x_m = nullptr, *y_m = nullptr, *heading_rad = nullptr;
  for (Channel& c : r.channels) {
    if (c.name == "truth_x_m") x_m = &c.values;
    if (c.name == "truth_y_m") y_m = &c.values;
    if (c.name == "truth_heading_rad") heading_rad = &c.values;
  }
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    const Pose there = room * Pose{(*x_m)[i], (*y_m)[i], 0.0};
    (*x_m)[i] = there.x_m, (*y_m)[i] = there.y_m, (*heading_rad)[i] += room.heading_rad;
  }
  return r;
}

}  // namespace odolab::test
