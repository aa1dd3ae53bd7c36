// An incremental encoder on a wheel: it counts whole pulses.
#pragma once

#include <cmath>

#include "core/geometry/angles.h"

namespace odolab {

class Encoder {
 public:
  // `phase`: where between two pulses the wheel stands at the start, 0 to 1.
  Encoder(double counts_per_wheel_turn, double phase)
      : counts_per_rad_(counts_per_wheel_turn / (2.0 * kPi)), phase_(phase) {}

  // Pulses since the start at a rotation of the wheel.
  double counts(double rotation_rad) const { return std::floor(rotation_rad * counts_per_rad_ + phase_); }
  // The same as the rotation that the robot takes it for.
  double reading_rad(double rotation_rad) const { return counts(rotation_rad) / counts_per_rad_; }

 private:
  double counts_per_rad_;
  double phase_;
};

}  // namespace odolab
