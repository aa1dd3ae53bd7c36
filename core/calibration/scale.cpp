#include "core/calibration/scale.h"

namespace odolab {

std::optional<ScaleCalibration> calibrate_scale(const TapeReading& reading, const DifferentialDrive& nominal) {
  if (!(reading.calculated_m > 0.0) || !(reading.actual_m > 0.0) || !problems_in(nominal).empty()) return std::nullopt;
  ScaleCalibration c;
  c.scaling_error = reading.calculated_m / reading.actual_m;  // Eq. B.1
  c.scaling_error_stderr = c.scaling_error * reading.tape_accuracy_m / reading.actual_m;
  // Calculated = pi D_n N, actual = pi D N for the same N turns: so D = D_n actual / calculated = D_n / Es. Eq. B.2
  // prints D_n* = Es D_n, which would double the error; it belongs to the inverse quotient.
  c.corrected = nominal;
  c.corrected.wheel_radius_left_m = nominal.wheel_radius_left_m / c.scaling_error;
  c.corrected.wheel_radius_right_m = nominal.wheel_radius_right_m / c.scaling_error;
  return c;
}

}  // namespace odolab
