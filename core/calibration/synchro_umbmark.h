// UMBmark for a synchro drive: what the report leaves for future work (section 7.1, "it may be possible to derive a
// calibration procedure [...] for the Cybermotion platform instead of the LabMate").
//
// The two clusters of a synchro drive look like those of a differential drive and mean something else: its base does
// not turn with its heading, so that unequal wheels turn it one way on the way out and back on the way back. With a the
// turn that is missing in each corner, c the base's turn for each metre whatever the direction, and A cos(d) + B sin(d)
// the one that depends on the wheels' direction d in the base's frame, the square of side L returns, to first order, to
//   1. x_cw  = -2 L a - 2 L^2 c + L^2 A,   x_ccw = -2 L a + 2 L^2 c - L^2 A
//   2. y_cw  = -2 L a - 2 L^2 c + L^2 B,   y_ccw = +2 L a - 2 L^2 c - L^2 B
// Four coordinates, four unknowns: a from the sum of x, c from the sum of y, A and B from the differences.
#pragma once

#include <array>
#include <optional>

#include "core/calibration/umbmark.h"
#include "core/vehicle/synchro_drive.h"

namespace odolab {

struct SynchroCalibration {
  double corner_error_rad = 0.0;         // a: the turn that is missing in each corner, > 0: turns too little
  double base_turn_rad_per_m = 0.0;      // c
  double base_turn_cos_rad_per_m = 0.0;  // A
  double base_turn_sin_rad_per_m = 0.0;  // B
  // Of the four, from the spread of the runs; none where a direction has but one.
  std::optional<std::array<double, 4>> standard_errors;
  SynchroDrive corrected;
};

// Solved on the exact path and not to first order. Nothing without a run in each direction.
std::optional<SynchroCalibration> calibrate_synchro(const UmbmarkRuns& runs, const SynchroDrive& nominal);

// Where a synchro drive ends that drives a square by what it believes to be, being what it actually is.
ReturnError synchro_square_return_error(const SynchroDrive& actual, const SynchroDrive& believed, double side_m,
                                        bool clockwise);

}  // namespace odolab
