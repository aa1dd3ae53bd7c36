// What a truth that is off, here so and there otherwise, says more than the body moves.
#pragma once

#include <functional>
#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

// How far off the truth is along x and y of the floor, and in heading, for an amplitude of one.
struct TruthOff {
  Vec2 by;
  double turned_rad = 0.0;
};
using TruthOffsets = std::function<void(int recording, const EffectStep&, std::vector<TruthOff>&)>;

// Of each of so many amplitudes, step by step: from where it was off to where it is off now; and a body whose heading
// is measured turned goes to the other side of that.
std::vector<Motions> motions_of_truth_off(const DriveView& view, const TruthOffsets& offsets, std::size_t count);

}  // namespace odolab
