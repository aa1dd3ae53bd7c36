#include "core/vehicle/tracked.h"

#include "core/vehicle/demands.h"

namespace odolab {

std::vector<std::string> problems_in(const Tracked& v) {
  Demands demands;
  demands.above_zero("sprocket_radius_left_m", v.sprocket_radius_left_m, "a length in metres");
  demands.above_zero("sprocket_radius_right_m", v.sprocket_radius_right_m, "a length in metres");
  demands.above_zero("track_width_m", v.track_width_m, "a length in metres");
  demands.length_below("sprocket_radius_left_m", v.sprocket_radius_left_m, 10.0);
  demands.length_below("sprocket_radius_right_m", v.sprocket_radius_right_m, 10.0);
  demands.length_below("track_width_m", v.track_width_m, 50.0);
  demands.above_zero("slip_factor", v.slip_factor, "a ratio");
  demands.above_zero("encoder_counts_per_revolution", v.encoder_counts_per_revolution, "a number of counts");
  demands.above_zero("gear_ratio", v.gear_ratio, "a ratio");
  demands.counter_bits(v.counter_bits);
  return std::move(demands).problems();
}

DifferentialDrive as_differential_drive(const Tracked& v) {
  DifferentialDrive drive;
  drive.wheel_radius_left_m = v.sprocket_radius_left_m;
  drive.wheel_radius_right_m = v.sprocket_radius_right_m;
  drive.wheelbase_m = v.track_width_m * v.slip_factor;
  drive.encoder_counts_per_revolution = v.encoder_counts_per_revolution;
  drive.gear_ratio = v.gear_ratio;
  drive.counter_bits = v.counter_bits;
  drive.counts_are_assumed = v.counts_are_assumed;
  return drive;
}

}  // namespace odolab
