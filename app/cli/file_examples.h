// What a newcomer has to write by hand, as the help of the commands that read it shows it.
#pragma once

namespace odolab {

inline constexpr char kVehicleAndRecordings[] =
    R"(The vehicle's file, of a differential drive (other kinds: assets/vehicles):
  kind = "differential_drive"
  name = "LabMate"
  [differential_drive]
  wheel_radius_left_m = 0.075
  wheel_radius_right_m = 0.075
  wheelbase_m = 0.340
  encoder_counts_per_revolution = 2000   # may be left out where recordings have rotations
  [truth_mounting]                       # where the tracked point sits; may be left out
  x_m = 0.10                             # from the middle of the axle, forward
  y_m = 0.0                              # to the left
  heading_rad = 0.0

A recording, with empty cells where a channel was not sampled (nan, NA, N/A, null and none are read as empty, inf is
refused); left_ticks and right_ticks may stand for the rotations:
  time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m,truth_heading_rad
  0.00,0,0,1.000,2.000,0.100
  0.02,0.0131,0.0129,,,)";

}  // namespace odolab
