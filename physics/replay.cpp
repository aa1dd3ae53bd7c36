#include "physics/replay.h"

#include "core/odometry/prediction.h"
#include "physics/simulation.h"

namespace odolab {

Scenario replay_scenario(const Vehicle& vehicle, const Recording& recording) {
  Scenario scenario;
  scenario.name = "Replay of " + recording.name;
  scenario.vehicle = vehicle;
  const auto& drive = std::get<DifferentialDrive>(vehicle.kind);
  scenario.actual = as_drawn(drive);
  ReplayPath path;
  path.recording = recording.name;
  path.by = wheel_samples(recording, drive).empty() ? ReplayPath::By::commands : ReplayPath::By::wheels;
  scenario.path = path;
  return scenario;
}

Result<Replay> replay(const Scenario& scenario, std::shared_ptr<const Recording> recording, const Progress& progress) {
  Result<Track> reckoned = predicted_track(*recording, scenario.vehicle);
  if (!reckoned) return reckoned.error();
  Simulation simulation(scenario, scenario.seed, recording);
  const double begin_s = simulation.state().time_s, duration_s = simulation.expected_duration_s();
  for (int k = 0; !simulation.state().finished; ++k) {
    simulation.step();
    if (k % 1000 == 0 && !goes_on(progress, (simulation.state().time_s - begin_s) / duration_s))
      return Error{recording->name, "the replay stopped by its user", "a replay to the end"};
  }
  Replay result;
  result.truth = truth_track(*recording);
  result.dead_reckoned = *reckoned;
  const TruthMounting truth = simulation.truth_mounting();
  for (const TimedPose& p : simulation.true_track())
    result.simulated.push_back({p.time_s + truth.time_offset_s, p.pose * truth.axle_T_tracked});
  result.simulated_error = track_error(result.simulated, result.truth);
  result.dead_reckoned_error = track_error(result.dead_reckoned, result.truth);
  return result;
}

}  // namespace odolab
