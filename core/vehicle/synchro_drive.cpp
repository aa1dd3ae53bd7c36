#include "core/vehicle/synchro_drive.h"

#include "core/vehicle/demands.h"

namespace odolab {

std::vector<std::string> problems_in(const SynchroDrive& drive) {
  Demands demands;
  demands.above_zero("wheel_radius_m", drive.wheel_radius_m, "a length in metres");
  demands.length_below("wheel_radius_m", drive.wheel_radius_m, 10.0);
  demands.above_zero("steering_ratio", drive.steering_ratio, "a ratio");
  demands.within("wheel_rad_per_steering_rad", drive.wheel_rad_per_steering_rad, 10.0, "a ratio");
  demands.within("base_turn_rad_per_m", drive.base_turn_rad_per_m, 1.0, "an angle for each metre");
  demands.within("base_turn_rad_per_steering_rad", drive.base_turn_rad_per_steering_rad, 0.5, "a ratio");
  demands.within("base_turn_cos_rad_per_m", drive.base_turn_cos_rad_per_m, 1.0, "an angle for each metre");
  demands.within("base_turn_sin_rad_per_m", drive.base_turn_sin_rad_per_m, 1.0, "an angle for each metre");
  demands.above_zero("drive_counts_per_revolution", drive.drive_counts_per_revolution, "a number of counts");
  demands.above_zero("steering_counts_per_revolution", drive.steering_counts_per_revolution, "a number of counts");
  return std::move(demands).problems();
}

}  // namespace odolab
