// Counts of all units' wheels without what their encoders made of them.
#pragma once

#include <vector>

#include "core/calibration/left_out.h"
#include "core/diagnosis/units/others_way.h"

namespace odolab {

// Where a wheel's count held and then caught up, it goes evenly instead; where it held, and lost what the wheel turned
// meanwhile, or jumped, it goes on at the pace before and behind; and where it moved alone at rest it goes on from
// there. What is told by all units together is not to be led astray by it; a unit's own recording keeps it, to be
// found.
struct MendedCounts {
  std::vector<UnitSample> samples;
  // Of each unit: where what one of its wheels turned is a guess, or which way they went, since it swung round.
  std::vector<TimeStretches> guessed;
};
MendedCounts with_mended_counts(std::vector<UnitSample> samples, const Vehicle& vehicle);
std::vector<Understood> with_mended_counts(std::vector<Understood> recordings, const Vehicle& vehicle);

}  // namespace odolab
