#include "core/odometry/encoder_step.h"

#include <cmath>

#include "core/geometry/angles.h"

namespace odolab {

double correction_rad(double difference_rad, double step_rad, ResolutionRule rule) {
  const double difference = wrapped(difference_rad);
  switch (rule) {
    case ResolutionRule::dead_band:
      return std::abs(difference) > step_rad ? difference : 0.0;
    case ResolutionRule::least_correction:
      if (std::abs(difference) <= 0.5 * step_rad) return 0.0;
      return difference - std::copysign(0.5 * step_rad, difference);
    case ResolutionRule::as_printed:
      break;
  }
  return difference;
}

}  // namespace odolab
