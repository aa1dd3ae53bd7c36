// One step of a synchro drive's dead reckoning: one motor drives all wheels, one steers them all.
#pragma once

#include "core/odometry/differential_drive.h"
#include "core/vehicle/synchro_drive.h"

namespace odolab {

// Where the vehicle is, the heading being the wheels' direction, and how its base stands.
struct SynchroPose {
  Pose pose;
  double base_heading_rad = 0.0;
};

// One step from what both encoders turned since the last one. With s the steering angle, u the travel and d the wheels'
// direction in the base's frame, the base turns by c u + (A cos d + B sin d) u + k s.
inline SynchroPose dead_reckoned(const SynchroPose& at, double wheel_rad, double steering_rad,
                                 const SynchroDrive& drive, HeadingRule rule = HeadingRule::middle) {
  const double steered_rad = steering_rad / drive.steering_ratio;
  const double travel_m = drive.wheel_radius_m * (wheel_rad - drive.wheel_rad_per_steering_rad * steered_rad);
  const double direction_rad = at.pose.heading_rad - at.base_heading_rad + 0.5 * steered_rad;
  const double base_turn_rad =
      travel_m * (drive.base_turn_rad_per_m + drive.base_turn_cos_rad_per_m * std::cos(direction_rad) +
                  drive.base_turn_sin_rad_per_m * std::sin(direction_rad)) +
      drive.base_turn_rad_per_steering_rad * steered_rad;
  const double turn_rad = steered_rad + base_turn_rad;
  const double along_rad = at.pose.heading_rad + (rule == HeadingRule::middle ? 0.5 : 1.0) * turn_rad;
  return {{at.pose.x_m + travel_m * std::cos(along_rad), at.pose.y_m + travel_m * std::sin(along_rad),
           at.pose.heading_rad + turn_rad},
          at.base_heading_rad + base_turn_rad};
}

}  // namespace odolab
