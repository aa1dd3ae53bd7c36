#include "core/vehicle/differential_drive.h"

#include "core/vehicle/demands.h"

namespace odolab {

std::vector<std::string> problems_in(const DifferentialDrive& drive) {
  Demands demands;
  demands.wheels(drive.wheel_radius_left_m, drive.wheel_radius_right_m, drive.wheelbase_m);
  demands.above_zero("encoder_counts_per_revolution", drive.encoder_counts_per_revolution, "a number of counts");
  demands.above_zero("gear_ratio", drive.gear_ratio, "a ratio");
  demands.counter_bits(drive.counter_bits);
  return std::move(demands).problems();
}

}  // namespace odolab
