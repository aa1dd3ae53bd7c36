// Dead reckoning of a differential drive from its encoders alone: UMBmark report, Eqs. 2.1 to 2.6.
#pragma once

#include "core/geometry/small_turn.h"
#include "core/geometry/track.h"
#include "core/recording/vehicle_samples.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

// The heading at which an increment of travel is laid down.
enum class HeadingRule {
  middle,          // of the interval: exact on arcs to second order
  arc,             // the same with the arc's chord in the place of its length: exact where both wheels turn evenly
  end_as_printed,  // Eq. 2.6 to the letter: the heading after the increment
};

// One step of dead reckoning from the rotation of both wheels since the last one.
inline Pose dead_reckoned(const Pose& pose, double left_rad, double right_rad, const DifferentialDrive& drive,
                          HeadingRule rule = HeadingRule::middle) {
  const double left_m = drive.wheel_radius_left_m * left_rad;      // Eqs. 2.1, 2.2
  const double right_m = drive.wheel_radius_right_m * right_rad;   //
  const double travel_m = 0.5 * (right_m + left_m);                // Eq. 2.3
  const double turn_rad = (right_m - left_m) / drive.wheelbase_m;  // Eq. 2.4
  if (rule == HeadingRule::middle) return advanced(pose, travel_m, turn_rad);
  if (rule == HeadingRule::arc) return advanced(pose, chord_share(turn_rad) * travel_m, turn_rad);
  const double heading_rad = pose.heading_rad + turn_rad;  // Eq. 2.5
  return {pose.x_m + travel_m * std::cos(heading_rad),     // Eq. 2.6a
          pose.y_m + travel_m * std::sin(heading_rad),     // Eq. 2.6b
          heading_rad};
}

// The same between two readings of both wheels.
inline Pose dead_reckoned(const Pose& pose, const WheelRotation& from, const WheelRotation& to,
                          const DifferentialDrive& drive, HeadingRule rule = HeadingRule::middle) {
  return dead_reckoned(pose, to.left_rad - from.left_rad, to.right_rad - from.right_rad, drive, rule);
}

// The track of the axle's centre through all wheel samples, from the given start.
Track dead_reckoned(const std::vector<WheelSample>& wheels, const DifferentialDrive& drive, const Pose& start,
                    HeadingRule rule = HeadingRule::middle);

// The same from commands, each held until the next.
Track dead_reckoned(const std::vector<CommandSample>& commands, const Pose& start);

}  // namespace odolab
