// Where a filter begins that is told places and no headings.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

struct UnknownHeading {
  double guess_rad = 0.0, stderr_rad = 1.0;
};

// The heading that lays the first metres of dead reckoning onto a truth without headings. Its error is taken ten times
// as large as the truth's noise makes it, since the filter uses the same samples again, and between a tenth of a radian
// and one. Not wider than need be: at rest a filter that knows nothing of the heading turns it about the tracked point
// with every sample, each time as if it had learned something.
UnknownHeading heading_from_shape(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                                  int first, int last);

}  // namespace odolab
