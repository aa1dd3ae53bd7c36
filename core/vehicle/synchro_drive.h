// A synchro drive: one motor drives all wheels, one steers them all; the base itself does not turn.
#pragma once

#include <string>
#include <vector>

namespace odolab {

// What odometry needs to know of a synchro drive. Its heading is the wheels' rolling direction, with which the turret
// turns. The defaults are a Cybermotion K2A's in kind; the UMBmark report gives no dimensions.
struct SynchroDrive {
  static constexpr const char* kKind = "synchro_drive";

  double wheel_radius_m = 0.127;  // rolling radius
  // The steering encoder's angle over the angle by which the wheels really turn.
  double steering_ratio = 1.0;
  // Steering makes a wheel that touches the floor beside its steering axis roll: rotation of the wheels for each radian
  // of steering that moves nothing.
  double wheel_rad_per_steering_rad = 0.0;
  // The base should keep its direction; unequal wheels and misalignment turn it slowly, in the travel and in steering.
  double base_turn_rad_per_m = 0.0;
  double base_turn_rad_per_steering_rad = 0.0;
  // Three wheels that differ in size or direction turn it by A cos(d) + B sin(d) of the travel, d being their direction
  // in the base's frame: it changes its sign on the way back.
  double base_turn_cos_rad_per_m = 0.0;
  double base_turn_sin_rad_per_m = 0.0;
  double drive_counts_per_revolution = 2000.0;     // of the wheel
  double steering_counts_per_revolution = 2000.0;  // of the turret
};

// Everything that makes these parameters unusable, each a sentence that starts with the key.
std::vector<std::string> problems_in(const SynchroDrive& drive);

}  // namespace odolab
