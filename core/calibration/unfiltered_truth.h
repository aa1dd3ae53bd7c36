// Calibration by what had been measured, where the truth was filtered before it was recorded: a truth that is late by
// the filter's time, cuts corners, and whose noise lasts as long.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/least_squares.h"

namespace odolab {

std::string filter_in_words(const TruthFilter& filter);

// The filter with which what had been measured is likeliest, as samples of independent noise (README.md in this folder,
// Eq. 16), and the calibration by that. Nothing where the samples as they are are as likely, or where what had been
// measured is not independent either: that was no such filter. `as_it_is`: the calibration by all samples.
std::optional<LeastSquaresCalibration> calibrated_unfiltered(const LeastSquaresCalibration& as_it_is,
                                                             const std::vector<Recording>& recordings,
                                                             const Vehicle& nominal, const LeastSquaresOptions& options,
                                                             const Progress& progress);

}  // namespace odolab
