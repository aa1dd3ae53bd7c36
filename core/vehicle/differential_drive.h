// A differential drive: two driven wheels on one axle line, castors carry the rest.
#pragma once

#include <string>
#include <vector>

namespace odolab {

// What odometry needs to know of a differential drive. The defaults are the TRC LabMate of the UMBmark report.
struct DifferentialDrive {
  static constexpr const char* kKind = "differential_drive";  // of the vehicle file

  double wheel_radius_left_m = 0.075;   // rolling radius
  double wheel_radius_right_m = 0.075;  // rolling radius
  double wheelbase_m = 0.340;           // between the two points where the wheels touch the floor
  // Pulses per turn of the encoder's shaft, which turns gear_ratio times as fast as the wheel (Ce and n of Eq. 2.1).
  double encoder_counts_per_revolution = 2000.0;
  double gear_ratio = 1.0;
  int counter_bits = 0;  // a raw counter wraps around at 2^bits; 0: it never does
  bool counts_are_assumed = false;  // nobody said how many: ticks cannot be read

  double counts_per_wheel_turn() const { return encoder_counts_per_revolution * gear_ratio; }
};

// Everything that makes these parameters unusable, each a sentence that starts with the key.
std::vector<std::string> problems_in(const DifferentialDrive& drive);

}  // namespace odolab
