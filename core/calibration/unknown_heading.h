// Where a filter begins that is told places and no headings.
#pragma once

#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

struct UnknownHeading {
  double guess_rad = 0.0, stderr_rad = 1.0;
  double reach_m = 0.0;  // from the start, of the places that found it, root mean square
};

// The heading that lays the first metres of dead reckoning onto a truth without headings. Its error is taken ten times
// as large as the truth's noise makes it, since the filter uses the same samples again, and between a tenth of a radian
// and one. Not wider than need be: at rest a filter that knows nothing of the heading turns it about the tracked point
// with every sample, each time as if it had learned something.
UnknownHeading heading_from_shape(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                                  int first, int last);

// So few samples without headings that none may be found with them, as of the poses at both ends of a run.
bool may_leave_heading_open(const InnovationRun& run);

// Headings all around, each uncertain by its distance from the next, where the places that would find one are hardly
// further away than they err: whatever was laid onto these would seem to lead as far as noise does. Else none.
std::vector<UnknownHeading> headings_all_around(const InnovationRun& run, const SummedRun& summed,
                                                const InnovationModel& model, int first, int last);

// How likely each of some headings is by all samples: README.md in this folder, Eq. 7b.
struct HeadingsWeighed {
  std::vector<double> weight;  // their sum is 1
  double minus_two_log_likelihood = 0.0;
};
HeadingsWeighed headings_weighed(const std::vector<double>& minus_two_log_likelihoods);

}  // namespace odolab
