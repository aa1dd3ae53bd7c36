// A vehicle that tows a small trailer with encoders on its wheels: the Basic Encoder Trailer of the UMBmark report,
// section 4.5.
#pragma once

#include <string>
#include <vector>

#include "core/vehicle/differential_drive.h"

namespace odolab {

// What odometry needs to know. The hitch sits behind the towing vehicle's centre; the trailer is rigid from the hitch
// to its axle, swivels freely and leads when the vehicle reverses. The hitch angle is the towing vehicle's heading
// minus the trailer's: zero in a straight train. The report gives no dimensions; the defaults are assumptions.
struct EncoderTrailer {
  static constexpr const char* kKind = "encoder_trailer";

  DifferentialDrive tow;  // of a tracked vehicle: sprocket radius, effective width of its tracks
  DifferentialDrive trailer = {.wheel_radius_left_m = 0.05, .wheel_radius_right_m = 0.05, .wheelbase_m = 0.30};
  double hitch_offset_m = 0.50;    // from the towing vehicle's centre back to the hitch
  double drawbar_length_m = 0.40;  // from the hitch to the trailer's axle
  double hitch_angle_resolution_rad = 0.0052;
  double hitch_angle_offset_rad = 0.0;  // reading minus truth
};

std::vector<std::string> problems_in(const EncoderTrailer& vehicle);

}  // namespace odolab
