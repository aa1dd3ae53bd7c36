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

// The pull of a tilted floor on a body in the next step.
inline void pull_downhill(PlanarWorld& world, int body, double mass_kg, const Floor& floor) {
  if (floor.tilt_rad == 0.0) return;
  const double pull_n = mass_kg * kGravity_mps2 * std::sin(floor.tilt_rad);
  world.apply_force(body,
                    {pull_n * std::cos(floor.downhill_direction_rad), pull_n * std::sin(floor.downhill_direction_rad)});
}

}  // namespace odolab
