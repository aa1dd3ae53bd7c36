// The scaling error of a vehicle from a straight drive and a tape measure: UMBmark report, Appendix B.
#pragma once

#include <optional>

#include "core/vehicle/differential_drive.h"

namespace odolab {

// One straight drive: how far the robot believes to have gone, and how far the tape says it went.
struct TapeReading {
  double calculated_m = 0.0;
  double actual_m = 0.0;
  double tape_accuracy_m = 0.001;  // standard deviation of the reading
};

struct ScaleCalibration {
  double scaling_error = 1.0;         // Es = calculated / actual, Eq. B.1
  double scaling_error_stderr = 0.0;  // from the tape's accuracy
  DifferentialDrive corrected;        // both radii divided by Es
};

// Nothing where a distance is not above zero or the drive is unusable.
std::optional<ScaleCalibration> calibrate_scale(const TapeReading& reading, const DifferentialDrive& nominal);

}  // namespace odolab
