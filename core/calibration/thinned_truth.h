// What a wheel's errors add up to over some way, apart from how they begin.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

struct ThinnedTruth {
  InnovationRun run;  // without its wheels: they are summed up
  SummedRun summed;   // without derivatives
};

// The run with only so much of its truth that a wheel rolls `way_m` or more from one sample to the next. A floor's
// unevenness has a length, so that a wheel's error from one sample to the next is not independent of the one before;
// over a tenth of a metre it is, and what adds up over long ways is that. `summed`: the run summed up under the model.
ThinnedTruth thinned_truth(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                           double way_m);

}  // namespace odolab
