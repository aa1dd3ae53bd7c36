#include "physics/experiments/clapper_runs.h"

#include <cmath>

namespace odolab {

Scenario report_clapper(Path path, bool internal_correction) {
  Scenario scenario;
  scenario.name = "CLAPPER";
  scenario.vehicle.name = "CLAPPER";
  scenario.vehicle.kind = Clapper{};
  scenario.path = std::move(path);
  scenario.driving.speed_mps = 0.45;
  scenario.driving.turn_rate_radps = 0.3;
  scenario.driving.turn_acceleration_radps2 = 0.25;
  scenario.driving.internal_correction = internal_correction;
  scenario.sensors.encoder_period_s = 0.040;
  scenario.sensors.truth_period_s = 0.0;
  scenario.sensors.truth_position_noise_m = 0.002;
  scenario.sensors.truth_heading_noise_rad = radians(0.25);
  return scenario;
}

std::string report_clapper_assumptions() {
  return "link of 1 m with a 2 Hz spring, trucks of 50 kg, a smooth floor, 0.45 m/s (\"slightly below 0.5\"), bumps of "
         "10 "
         "mm round which a wheel of 75 mm turns 3.5 mm further than it travels";
}

double ReturnPose::position_m() const { return std::hypot(x_m, y_m); }

ReturnPose return_error(const Simulation& simulation) {
  const Pose driven = between(simulation.estimated_track().front().pose, simulation.state().estimated_pose);
  const Pose measured = between(simulation.measured_start(), simulation.measured_end());
  return {measured.x_m - driven.x_m, measured.y_m - driven.y_m, wrapped(measured.heading_rad - driven.heading_rad),
          simulation.state().finished};
}

ReturnPose run_and_return(Simulation& simulation) {
  run_to_end(simulation, 3.0 * simulation.expected_duration_s());
  return return_error(simulation);
}

}  // namespace odolab
