// Where the direction of travel reverses.
#pragma once

#include <cstddef>
#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

struct Reversal {
  std::size_t first = 0;  // step of the way back
  std::size_t sure = 0;   // the step by which it counts
  int direction = 1;      // of travel, from here on
  double back_m = 0.0;    // how far it has gone by then
};

constexpr double kReversed_m = 0.01;  // way back that counts; less is the trembling of a turn on the spot

std::vector<Reversal> reversals(const DriveView& view);

}  // namespace odolab
