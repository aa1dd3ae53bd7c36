// A robot, its floor and its sensors, drawn at random.
#pragma once

#include "core/base/random.h"
#include "core/scenario/scenario.h"

namespace odolab::concealed {

struct DrawnRobot {
  Scenario
      scenario;  // vehicle file (wrong by up to 2 % in each radius and 4 % in the wheelbase), machine, floor, sensors
  double rolling_noise_m_per_sqrt_m = 0.0;  // of each wheel, beside what the floor's roughness does
  double stamp_jitter_s = 0.0;              // standard deviation of the truth's stamps about the true times

  const DifferentialDrive& nominal() const { return std::get<DifferentialDrive>(scenario.vehicle.kind); }
  DifferentialDrive actual() const;  // as the machine really is
  // Wheel noise of floor and wheels together, per root metre.
  double wheel_noise_m_per_sqrt_m() const;
};

// `smooth`: without roughness; wheels that roll unevenly are the only noise then.
DrawnRobot drawn_robot(Random& random, bool smooth);

}  // namespace odolab::concealed
