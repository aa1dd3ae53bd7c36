// A vehicle that tows a Smart Encoder Trailer: Internal Position Error Correction with a passive truck B (UMBmark
// report, section 4.6).
#pragma once

#include <string>
#include <vector>

#include "core/vehicle/differential_drive.h"

namespace odolab {

// What odometry needs to know. The hitch, with its absolute encoder, sits at the towing vehicle's centre ("the absolute
// rotary encoder on the center of the robot"); the trailer is rigid from there to its axle. The hitch angle is the
// towing vehicle's heading minus the trailer's. Lengths of the trailer are assumptions: the report gives none.
struct SmartEncoderTrailer {
  static constexpr const char* kKind = "smart_encoder_trailer";

  DifferentialDrive tow;  // truck A
  DifferentialDrive trailer = {.wheel_radius_left_m = 0.05, .wheel_radius_right_m = 0.05, .wheelbase_m = 0.30};
  double drawbar_length_m = 1.0;  // from the hitch to the trailer's axle
  double hitch_angle_resolution_rad = 0.0052;
  double hitch_angle_offset_rad = 0.0;  // reading minus truth
};

std::vector<std::string> problems_in(const SmartEncoderTrailer& vehicle);

}  // namespace odolab
