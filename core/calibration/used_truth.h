// The truth by which a calibration went: without what it set aside.
#pragma once

#include <vector>

#include "core/calibration/least_squares.h"
#include "core/geometry/track.h"

namespace odolab {

struct UsedTruth {
  Track track;             // where headings are known
  std::vector<char> anew;  // of each pose: whether the fit began anew there, since so much before it contradicts
};

// Of one of the recordings that were calibrated, number `index`, as `options` had it: but for samples that repeat
// themselves or contradict their neighbours. All of it where that cannot be told again.
UsedTruth used_truth(const Recording& recording, const LeastSquaresCalibration& calibration, std::size_t index,
                     const LeastSquaresOptions& options);

}  // namespace odolab
