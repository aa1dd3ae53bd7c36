// Calibration by all truth samples that are there, as if their noise were white: README.md in this folder, Eqs. 10
// to 12.
#pragma once

#include "core/calibration/least_squares.h"

namespace odolab {

Result<LeastSquaresCalibration> calibrated_by_all(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                  const LeastSquaresOptions& options, const Progress& progress);

}  // namespace odolab
