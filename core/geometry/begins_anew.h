// Where the comparison of two tracks starts again.
#pragma once

#include <utility>
#include <vector>

#include "core/geometry/track.h"

namespace odolab {

// Of each pose of a reference, as track_error() takes it: whether one of the stretches over which the way is not known
// (from, to, on its clock) lies between it and the one before.
inline std::vector<char> begins_anew(const Track& reference, const std::vector<std::pair<double, double>>& unknown_s) {
  std::vector<char> anew(reference.size(), 0);
  for (std::size_t i = 1; i < reference.size(); ++i)
    for (const auto& [from_s, to_s] : unknown_s)
      if (reference[i].time_s > from_s && reference[i - 1].time_s < to_s) anew[i] = 1;
  return anew;
}

}  // namespace odolab
