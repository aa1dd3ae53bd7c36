// Small steps that vehicles on driven axles share.
#pragma once

#include <cmath>

#include "core/scenario/floor.h"
#include "core/vehicle/differential_drive.h"
#include "physics/driver/base_command.h"
#include "physics/planar_world.h"
#include "physics/vehicles/driven_axle.h"
#include "physics/wheel_pair.h"

namespace odolab {

// The wheel speeds that a base speed and turn rate ask for, by the nominal geometry.
inline WheelPair wheel_speeds(const BaseCommand& command, const DifferentialDrive& drive) {
  const double half_base = 0.5 * drive.wheelbase_m * command.yaw_rate_radps;
  return {(command.speed_mps - half_base) / drive.wheel_radius_left_m,
          (command.speed_mps + half_base) / drive.wheel_radius_right_m};
}

inline WheelPair between(const WheelPair& before, const WheelPair& next, double share) {
  return {before.left + share * (next.left - before.left), before.right + share * (next.right - before.right)};
}

// How a body moves over the floor.
struct BodyVelocity {
  Vec2 velocity_mps;  // in the floor's frame
  double yaw_rate_radps = 0.0;

  // Of a point so far from the body's origin, in the floor's frame.
  Vec2 at(Vec2 arm) const { return velocity_mps + Vec2{-yaw_rate_radps * arm.y_m, yaw_rate_radps * arm.x_m}; }
};

// Of a body about its axle's centre whose wheels turn so and do not slip.
inline BodyVelocity rolling_motion(const Pose& body, const DifferentialDrive& wheels, WheelPair speed_radps) {
  const double left_mps = wheels.wheel_radius_left_m * speed_radps.left,
               right_mps = wheels.wheel_radius_right_m * speed_radps.right;
  return {rotated({0.5 * (left_mps + right_mps), 0.0}, body.heading_rad), (right_mps - left_mps) / wheels.wheelbase_m};
}

// Of a trailer about its axle's centre whose drawbar ends where something moves so.
inline BodyVelocity towed_motion(const Pose& trailer, double drawbar_length_m, Vec2 hitch_velocity_mps) {
  const Vec2 ahead = rotated({1.0, 0.0}, trailer.heading_rad);
  return {dot(hitch_velocity_mps, ahead) * ahead, cross(ahead, hitch_velocity_mps) / drawbar_length_m};
}

inline void set_in_motion(PlanarWorld& world, int body, const BodyVelocity& motion) {
  world.set_velocity(body, motion.velocity_mps, motion.yaw_rate_radps);
}

// The pull of a tilted floor on a body in the next step.
inline void pull_downhill(PlanarWorld& world, int body, double mass_kg, const Floor& floor) {
  if (floor.tilt_rad == 0.0) return;
  const double pull_n = mass_kg * kGravity_mps2 * std::sin(floor.tilt_rad);
  world.apply_force(body,
                    {pull_n * std::cos(floor.downhill_direction_rad), pull_n * std::sin(floor.downhill_direction_rad)});
}

}  // namespace odolab
