// When the wheels stand.
#pragma once

#include <cstddef>
#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

// Neither wheel is read to turn: both stand, or go by less than a count.
bool wheels_stand(const EffectStep& step);

// Steps in a row in which they do, from the first to the one before the end, and from when to when.
struct Rest {
  std::size_t first, end;
  double from_s, to_s;
  double lasts_s() const { return to_s - from_s; }
};
std::vector<Rest> rests(const DriveView& view);

}  // namespace odolab
