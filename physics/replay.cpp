#include "physics/replay.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/estimators.h"
#include "core/odometry/prediction.h"
#include "core/recording/vehicle_samples.h"
#include "core/scenario/suited_scenario.h"
#include "physics/simulation.h"

namespace odolab {

namespace {

// The turn about the first truth sample that lays the first two metres of a track onto the truth's positions.
double turn_onto(const Track& track, const std::vector<TruthSample>& truth) {
  constexpr double kFirst_m = 2.0;
  const auto start = pose_at(track, truth[0].time_s);
  double along = 0.0, across = 0.0, way_m = 0.0;
  for (std::size_t i = 1; start && i < truth.size() && way_m < kFirst_m; ++i) {
    way_m = std::max(way_m, length(truth[i].position - truth[0].position));
    const auto pose = pose_at(track, truth[i].time_s);
    if (!pose) continue;
    const Vec2 driven = pose->position() - start->position(), seen = truth[i].position - truth[0].position;
    along += dot(driven, seen);
    across += cross(driven, seen);
  }
  return std::atan2(across, along);
}

// Motors as the LabMate's are to its mass and its wheels.
Motor motor_for(const ActualDrive& machine) {
  const ActualDrive usual;
  const double mass = machine.mass_kg / usual.mass_kg, wheel = machine.wheel_radius_left_m / usual.wheel_radius_left_m;
  Motor motor;
  motor.torque_limit_nm *= mass * wheel;
  motor.wheel_inertia_kgm2 *= mass * wheel * wheel;
  motor.proportional_gain *= mass * wheel * wheel;
  motor.integral_gain *= mass * wheel * wheel;
  return motor;
}

// The first of several names, and how many others there are.
std::string in_brief(const std::string& names) {
  const auto others = std::count(names.begin(), names.end(), ',');
  return others < 2 ? names : names.substr(0, names.find(',')) + " and " + std::to_string(others) + " other columns";
}

}  // namespace

Scenario replay_scenario(const Vehicle& vehicle, const Recording& recording) {
  Scenario scenario = with_vehicle(Scenario{}, vehicle);
  scenario.name = "Replay of " + recording.name;
  if (const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind)) {
    scenario.actual = as_drawn(*drive);
    scenario.motor = motor_for(scenario.actual);
  }
  ReplayPath path;
  path.recording = recording.name;
  path.by = missing_columns(recording, vehicle).empty() ? ReplayPath::By::wheels : ReplayPath::By::commands;
  scenario.path = path;
  return scenario;
}

Result<Replay> replay(const Scenario& scenario, std::shared_ptr<const Recording> recording, const Progress& progress,
                      double picture_period_s) {
  const bool by_wheels = std::get<ReplayPath>(scenario.path).by == ReplayPath::By::wheels;
  const bool pair_of_wheels = encoder_channels(scenario.vehicle.kind).size() == 2;
  if (const std::string missing = missing_columns(*recording, scenario.vehicle); by_wheels && !missing.empty())
    return Error{recording->name + ": path.by",
                 "'wheels', but the recording has no " + (pair_of_wheels ? std::string("wheel rotation") : missing),
                 "'commands', or another recording"};
  const auto* drive = std::get_if<DifferentialDrive>(&scenario.vehicle.kind);
  if (by_wheels && drive && wheel_samples(*recording, *drive).size() < 2)
    return Error{recording->name + ": path.by", "'wheels', but the recording has one row of them",
                 "'commands', or another recording"};
  if (!by_wheels && !drive && command_samples(*recording).size() < 2)
    return Error{recording->name, "no " + in_brief(missing_columns(*recording, scenario.vehicle)),
                 "the encoders of a " + kind_name(scenario.vehicle) + ", or another vehicle to replay it with"};
  if (!by_wheels && command_samples(*recording).size() < 2)
    return Error{recording->name + ": path.by", "'commands', but the recording has none",
                 "'wheels', or another recording"};
  Result<Track> reckoned = predicted_track(*recording, scenario.vehicle);
  if (!reckoned) return reckoned.error();
  Scenario aligned = scenario;
  Replay result;
  result.truth = truth_track(*recording);
  if (const std::vector<TruthSample> samples = truth_samples(*recording);
      result.truth.size() < 2 && samples.size() >= 2) {
    result.truth_has_headings = false;
    aligned.start.heading_rad = turn_onto(*reckoned, samples);
    const Pose origin{samples[0].position.x_m, samples[0].position.y_m, 0.0};
    for (TimedPose& p : *reckoned)
      p.pose = origin * Pose{0.0, 0.0, aligned.start.heading_rad} * between(origin, p.pose);
    result.truth.clear();
    for (const TruthSample& s : samples)
      if (const auto pose = pose_at(*reckoned, s.time_s))
        result.truth.push_back({s.time_s, {s.position.x_m, s.position.y_m, pose->heading_rad}});
  }
  Simulation simulation(aligned, scenario.seed, recording);
  const double begin_s = simulation.state().time_s, duration_s = simulation.expected_duration_s();
  if (duration_s > 1e5)
    return Error{recording->name, "more than a day between truth and wheels", "one recording on one clock"};
  result.shape = simulation.shape();
  double next_picture_s = begin_s;
  const auto take_picture = [&] {
    if (picture_period_s <= 0.0 || simulation.state().time_s < next_picture_s - 1e-9) return;
    result.postures.push_back({simulation.state().time_s, simulation.posture()});
    next_picture_s += picture_period_s;
  };
  for (int k = 0; !simulation.state().finished; ++k) {
    take_picture();
    simulation.step();
    if (k % 1000 == 0 && !goes_on(progress, (simulation.state().time_s - begin_s) / duration_s))
      return Error{recording->name, "the replay stopped by its user", "a replay to the end"};
  }
  result.dead_reckoned = *reckoned;
  const TruthMounting truth = simulation.truth_mounting();
  for (TimedPosture& p : result.postures) {
    p.time_s += truth.time_offset_s;
    p.posture.reference = p.posture.reference * truth.axle_T_tracked;
  }
  for (const TimedPose& p : simulation.true_track())
    result.simulated.push_back({p.time_s + truth.time_offset_s, p.pose * truth.axle_T_tracked});
  result.simulated_error = track_error(result.simulated, result.truth);
  result.dead_reckoned_error = track_error(result.dead_reckoned, result.truth);
  return result;
}

}  // namespace odolab
