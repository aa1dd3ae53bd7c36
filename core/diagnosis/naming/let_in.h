// Letting a candidate into a model, and what it says once it is in.
#pragma once

#include <vector>

#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

// Lets a candidate in, in the place of a coarser one of its kind, and fits all: beside play of both wheels that of one
// is let in with the other's. Returns twice what the log-likelihood gains by it under the noise as it is; of a lag with
// the noise that it leaves, since how evenly commands are acted on is asked of the motion that lags.
double let_in(JointModel& joint, const ScoredCandidate& c);

// What comes nearest is asked once more under the noise that it leaves, if nothing is beyond doubt: what is there
// counts for more then, and what the noise is as good for counts for less. One moment moves no noise. Nor is asked
// again what chance would make one of all that is looked for (core/diagnosis/README.md, section 4).
void look_again(const JointModel& joint, std::vector<ScoredCandidate>& scored);

}  // namespace odolab
