// Clocks, before any physics is looked for: where they are off they blur all of it.
#pragma once

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Puts each recording's clock, and its rate where each has its own, to where that recording alone is likeliest: from
// where the moments say (core/calibration/aligned_clock) downhill without a slope. The model must have been linearised,
// and wants to be again.
void align_clocks(JointModel& joint);

// Where the moments put the clocks elsewhere than the fit did, and the likelihood agrees beyond doubt, noise and all:
// holds the clocks there, and lets their rate in, the same in all recordings or one in each, as far as each of these is
// the likelier beyond doubt too. What is weaker is left to the test that all effects pass.
void let_clocks_in(JointModel& joint);

}  // namespace odolab
