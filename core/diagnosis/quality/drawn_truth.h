// A truth whose gaps were filled with straight lines.
#pragma once

#include <vector>

#include "core/calibration/left_out.h"
#include "core/recording/recording.h"

namespace odolab {

// From the sample before such a line to the one behind it. On a line at least four samples in a row lie where their
// neighbours say, to a fiftieth of what measured ones are off that, in heading too. None where the truth does not
// tremble from sample to sample: the way of one without noise is as straight where the vehicle drives so; nor where it
// is rounded to what it trembles by.
TimeStretches drawn_truth(const std::vector<TruthSample>& truth);

}  // namespace odolab
