// Runs of a machine without faults of its own, in which one effect is switched on.
#pragma once

#include <cmath>
#include <vector>

#include "physics/simulation.h"
#include "test/support/finished_run.h"

namespace odolab {

constexpr double kRadius_m = 0.075, kBase_m = 0.340;

// Wheel speeds [rad/s] for a speed and a turn rate.
inline WheelSpeeds phase(double duration_s, double speed_mps, double yaw_rate_radps) {
  const double half = 0.5 * kBase_m * yaw_rate_radps;
  return {duration_s, (speed_mps - half) / kRadius_m, (speed_mps + half) / kRadius_m};
}

// Ideal motors, so that the wheels turn exactly as the table says: ramps of half a second between the phases.
inline Scenario table_drive(std::vector<WheelSpeeds> phases, std::vector<ActiveEffect> effects) {
  Scenario scenario;
  scenario.motor.ideal = true;
  scenario.path = WheelSpeedPath{std::move(phases), 0.5};
  scenario.effects = std::move(effects);
  return scenario;
}

inline Pose end_pose(const Scenario& scenario) { return finished(scenario).state().true_pose; }

}  // namespace odolab
