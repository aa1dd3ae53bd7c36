#include "physics/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/recording/vehicle_samples.h"
#include "core/scenario/effect_catalogue.h"
#include "physics/driver/path_follower.h"
#include "physics/driver/recorded_motion.h"
#include "physics/effects/effects.h"
#include "physics/sampled_run.h"
#include "physics/sensors/absolute_pose.h"
#include "physics/vehicles/planar_vehicle.h"

namespace odolab {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Streams of random numbers, one for each thing that draws.
enum Stream : std::uint64_t { kFloorStream = 1, kEncoderStream = 2, kTruthStream = 3 };

Side inside_of(const Path& path) {
  const auto* square = std::get_if<SquarePath>(&path);
  const auto* rectangle = std::get_if<RectanglePath>(&path);
  return (square && square->clockwise) || (rectangle && rectangle->clockwise) ? Side::right : Side::left;
}

Pose start_of(const Scenario& scenario, const Recording* replayed, const TruthMounting& mounting) {
  if (!replayed) return scenario.start;
  const std::vector<TruthSample> truth = truth_samples(*replayed);
  if (truth.empty()) return scenario.start;
  const Pose tracked{truth[0].position.x_m, truth[0].position.y_m,
                     truth[0].heading_rad.value_or(scenario.start.heading_rad)};
  return tracked * inverse(mounting.axle_T_tracked);
}

// On the clock of its encoders.
double replay_begin_s(const Recording& replayed, const TruthMounting& mounting, double without_truth_s) {
  const std::vector<TruthSample> truth = truth_samples(replayed);
  return truth.empty() ? without_truth_s : truth.front().time_s - mounting.time_offset_s;
}

// What the recording's encoders read where the replay begins; empty where it lacks one of them.
std::vector<double> first_readings(const Scenario& scenario, const Recording* replayed, const TruthMounting& mounting) {
  if (!replayed) return {};
  const AlignedRows rows = aligned_rows(*replayed, encoders_of(scenario.vehicle.kind));
  if (rows.time_s.empty()) return {};
  return RecordedRotation(rows.time_s, rows.values).at(replay_begin_s(*replayed, mounting, rows.time_s.front()));
}

Scenario with_effects_built_in(Scenario scenario, const planar::Effects& effects) {
  scenario.machine = effects.built_into(scenario.machine, scenario.vehicle.kind);
  return scenario;
}

// Those of parts are the parts' own business.
std::vector<ActiveEffect> of_the_whole(std::vector<ActiveEffect> effects) {
  const auto of_a_part = [](const ActiveEffect& e) {
    const bool of_a_joint =
        e.effect == "link_angle_bias" || e.effect == "link_length_bias" || e.effect == "pivot_angle_bias";
    return !of_a_joint && !part_component(e.component).part.empty();
  };
  effects.erase(std::remove_if(effects.begin(), effects.end(), of_a_part), effects.end());
  return effects;
}

// Steps between two readings of a sensor.
std::int64_t steps_in(double period_s, double step_s) {
  return std::max<std::int64_t>(1, std::llround(period_s / step_s));
}

}  // namespace

struct Simulation::Parts {
  Parts(const Scenario& given, std::uint64_t seed, std::shared_ptr<const Recording> recorded,
        const std::vector<std::shared_ptr<planar::Effect>>& own)
      : scenario(given),
        replayed(std::move(recorded)),
        effects(of_the_whole(scenario.effects), {scenario.actual, scenario.step_s}, own),
        mounting(effects.mounted(scenario.vehicle.truth)),
        floor_seed(seed_of_stream(seed, kFloorStream)),
        ground(effects.laid_on(scenario.floor), inside_of(scenario.path), floor_seed),
        start(start_of(scenario, replayed.get(), mounting)),
        built(with_effects_built_in(scenario, effects)),
        vehicle(make_planar_vehicle({built, start, effects, seed_of_stream(seed, kEncoderStream),
                                     first_readings(scenario, replayed.get(), mounting)})),
        driven_start(vehicle->believed_driven_point()),
        route(route_of(scenario.path, driven_start)),
        follower(route, scenario.driving, scenario.sensors.encoder_period_s),
        rotation(replays(ReplayPath::By::wheels)
                     ? recorded_rotation(*replayed, scenario.vehicle.kind, vehicle->turned_channels())
                     : RecordedRotation{}),
        commands(replays(ReplayPath::By::commands) ? command_samples(*replayed) : std::vector<CommandSample>{}),
        encoder_steps(steps_in(scenario.sensors.encoder_period_s, scenario.step_s)),
        truth_steps(scenario.sensors.truth_period_s > 0.0 ? steps_in(scenario.sensors.truth_period_s, scenario.step_s)
                                                          : 0),
        truth_noise(seed_of_stream(seed, kTruthStream)) {
    plan_duration();
    state.time_s = begin_s;
    state.true_pose = state.estimated_pose = start;
    vehicle->place_other_bodies(state.other_bodies);
    run.channels = vehicle->channels();
    gauges = vehicle->shape().gauges;
    sample_encoders();
    sample_truth();
    measured_start = measured_end = measured_axle();
    if (duration_s <= 0.0) finish();
  }

  bool replays(ReplayPath::By by) const {
    const auto* replay = std::get_if<ReplayPath>(&scenario.path);
    return replay && replayed && replay->by == by;
  }

  AbsolutePoseSensor sonar() const {
    return {scenario.sensors.truth_position_noise_m, scenario.sensors.truth_heading_noise_rad};
  }

  void plan_duration() {
    if (const auto* speeds = std::get_if<WheelSpeedPath>(&scenario.path)) {
      for (const WheelSpeeds& phase : speeds->phases) duration_s += phase.duration_s;
      duration_s += speeds->ramp_s + 2.0 * scenario.driving.stands_s;  // down to rest
    } else if (const auto* hand = std::get_if<HandPath>(&scenario.path)) {
      duration_s = hand->duration_s;
    } else if (std::holds_alternative<ReplayPath>(scenario.path)) {
      if (!replayed || (rotation.empty() && commands.empty())) return;
      const double first_s = rotation.empty() ? commands.first_s() : rotation.first_s();
      const double last_s = rotation.empty() ? commands.last_s() : rotation.last_s();
      begin_s = replay_begin_s(*replayed, mounting, first_s);
      duration_s = std::max(0.0, effects.empty() ? last_s - begin_s : effects.since_start_of_stamp_s(begin_s, last_s));
      vehicle->set_clock(begin_s);
      if (!rotation.empty()) {
        rotation_now = rotation.at(begin_s);
        vehicle->begin_in_motion(rotation.speed_at(begin_s));
      }
    } else {
      duration_s = duration_of(route, scenario.driving) + 2.0 * scenario.driving.stands_s;
      by_route = true;
    }
  }

  // The set speeds by a table of wheel speeds, at the middle of the step.
  WheelPair tabled_speeds(double time_s) const {
    const auto& table = std::get<WheelSpeedPath>(scenario.path);
    WheelPair before;
    double begin = scenario.driving.stands_s;
    if (time_s < begin) return {};
    for (std::size_t i = 0; i <= table.phases.size(); ++i) {
      const bool ending = i == table.phases.size();
      const WheelPair speeds =
          ending ? WheelPair{} : WheelPair{table.phases[i].left_radps, table.phases[i].right_radps};
      const double phase_s = ending ? table.ramp_s + 1.0 : table.phases[i].duration_s;
      if (time_s < begin + phase_s || ending) {
        const double u = table.ramp_s > 0.0 ? std::min(1.0, (time_s - begin) / table.ramp_s) : 1.0;
        return {before.left + u * (speeds.left - before.left), before.right + u * (speeds.right - before.right)};
      }
      before = speeds;
      begin += phase_s;
    }
    return {};
  }

  // What a recording that is replayed was stamped, this many steps after the start.
  double recorded_s(double after_steps) const {
    const double since_start_s = after_steps * scenario.step_s;
    return effects.empty() ? begin_s + since_start_s : effects.robot_stamp_s(begin_s, since_start_s);
  }

  // What the driver asks for in this step.
  CommandRamp command_now() {
    if (!commands.empty()) {
      const CommandSample c = commands.at(recorded_s(static_cast<double>(steps) + 0.5));
      return {{}, {c.speed_mps, c.yaw_rate_radps}, 1.0};
    }
    const double u = (static_cast<double>(steps % encoder_steps) + 0.5) / static_cast<double>(encoder_steps);
    return {command_before, command_next, u};
  }

  void drive_one_step() {
    const double h = scenario.step_s;
    if (!rotation.empty()) {
      std::vector<double> next = rotation.at(recorded_s(static_cast<double>(steps + 1)));
      std::vector<double> speeds = next;
      for (std::size_t i = 0; i < speeds.size(); ++i) speeds[i] = (next[i] - rotation_now[i]) / h;
      vehicle->turn(ground, scenario.floor, speeds);
      rotation_now = std::move(next);
    } else if (std::holds_alternative<WheelSpeedPath>(scenario.path)) {
      vehicle->by_wheels()->drive_wheels(ground, scenario.floor,
                                         tabled_speeds(begin_s + (static_cast<double>(steps) + 0.5) * h));
    } else {
      vehicle->drive(ground, scenario.floor, command_now());
    }
  }

  void step() {
    drive_one_step();
    ++steps;
    state.time_s = begin_s + static_cast<double>(steps) * scenario.step_s;
    state.true_pose = vehicle->pose();
    state.true_speed_mps = vehicle->speed_mps();
    state.true_yaw_rate_radps = vehicle->yaw_rate_radps();
    state.left = vehicle->left();
    state.right = vehicle->right();
    vehicle->place_other_bodies(state.other_bodies);
    if (steps % encoder_steps == 0) sample_encoders();
    if (truth_steps > 0 && steps % truth_steps == 0) sample_truth();
    if (has_ended()) finish();
  }

  bool has_ended() {
    if (by_route && !follower.finished()) return false;
    if (by_route && !arrived_s) arrived_s = state.time_s;
    return state.time_s >= (by_route ? *arrived_s + scenario.driving.stands_s : begin_s + duration_s) - 1e-9;
  }

  BaseCommand by_the_route() {
    if (state.time_s < begin_s + scenario.driving.stands_s) return {};
    return follower.update(scenario.driving.by_eye ? vehicle->pose() : vehicle->believed_driven_point());
  }

  void sample_encoders() {
    vehicle->sample(state.time_s, readings);
    run.readings.insert(run.readings.end(), readings.begin(), readings.end());
    run.time_s.push_back(state.time_s);
    read_gauges();
    state.estimated_pose = vehicle->believed();
    if (!keeps_tracks) drop_tracks();
    estimated.push_back({state.time_s, state.estimated_pose});
    exact.push_back({state.time_s, state.true_pose});
    command_before = command_next;
    if (by_route) command_next = by_the_route();
    if (std::holds_alternative<HandPath>(scenario.path)) command_next = by_hand();
    if (scenario.sensors.record_commands) record_command();
  }

  void drop_tracks() {
    estimated.clear();
    exact.clear();
  }

  void read_gauges() {
    if (gauges.empty()) return;
    vehicle->pose_parts(posture);
    gauges_read = posture.gauges;
    for (std::size_t i = 0; i < gauges.size(); ++i) {
      const auto channel = std::find(run.channels.begin(), run.channels.end(), gauges[i].channel);
      gauges_read[i].measured =
          channel == run.channels.end() ? kNone : readings[static_cast<std::size_t>(channel - run.channels.begin())];
    }
  }

  // What the driver asks of the base from now until the next sample, as commands are held until the next: their mean,
  // that is in the middle of that time. Of a path that knows wheel speeds alone, what they are for the nominal base.
  void record_command() {
    BaseCommand given{0.5 * (command_before.speed_mps + command_next.speed_mps),
                      0.5 * (command_before.yaw_rate_radps + command_next.yaw_rate_radps),
                      0.5 * (command_before.sideways_mps + command_next.sideways_mps)};
    if (std::holds_alternative<WheelSpeedPath>(scenario.path)) {
      const WheelPair speeds = tabled_speeds(state.time_s + 0.5 * scenario.sensors.encoder_period_s);
      given = vehicle->by_wheels()->motion_of(speeds);
    } else if (!commands.empty()) {
      const CommandSample c = commands.at(recorded_s(static_cast<double>(steps)));
      given = {c.speed_mps, c.yaw_rate_radps};
    } else if (!rotation.empty()) {
      given = {kNone, kNone};  // nobody commands wheels that are turned by a recording
    }
    run.commands.push_back(given);
  }

  // A hand's command, reached at no more than the driver's accelerations.
  BaseCommand by_hand() {
    const double period_s = scenario.sensors.encoder_period_s;
    const double dv = scenario.driving.acceleration_mps2 * period_s,
                 dw = scenario.driving.turn_acceleration_radps2 * period_s;
    hand_now.speed_mps = std::clamp(hand.speed_mps, hand_now.speed_mps - dv, hand_now.speed_mps + dv);
    hand_now.yaw_rate_radps =
        std::clamp(hand.yaw_rate_radps, hand_now.yaw_rate_radps - dw, hand_now.yaw_rate_radps + dw);
    hand_now.sideways_mps = std::clamp(hand.sideways_mps, hand_now.sideways_mps - dv, hand_now.sideways_mps + dv);
    return hand_now;
  }

  void sample_truth() {
    if (last_truth && last_truth->time_s == state.time_s) return;
    Pose measured = sonar().measure(state.true_pose * mounting.axle_T_tracked, truth_noise);
    for (const auto& effect : effects) effect->measure_truth(state.time_s, measured);
    last_truth = {state.time_s, measured};
    run.truth.push_back(*last_truth);
  }

  // The axle's pose as the last outside measurement shows it.
  Pose measured_axle() const { return last_truth->pose * inverse(scenario.vehicle.truth.axle_T_tracked); }

  void finish() {
    if (state.finished) return;
    state.finished = true;
    sample_truth();
    measured_end = measured_axle();
  }

  Scenario scenario;
  std::shared_ptr<const Recording> replayed;
  planar::Effects effects;
  TruthMounting mounting;  // as it really is
  std::uint64_t floor_seed;
  Ground ground;
  Pose start;
  Scenario built;  // with what effects change of the machine
  std::unique_ptr<PlanarVehicle> vehicle;
  Pose driven_start;
  std::vector<Leg> route;
  PathFollower follower;
  RecordedRotation rotation;
  RecordedCommands commands;
  std::int64_t encoder_steps, truth_steps;
  Random truth_noise;

  std::int64_t steps = 0;
  double begin_s = 0.0, duration_s = 0.0;
  bool by_route = false;
  std::optional<double> arrived_s;  // at the end of its route
  BaseCommand command_before, command_next;
  std::vector<double> rotation_now;  // of the motors that a recording turns
  BaseCommand hand, hand_now;
  SimulationState state;
  SampledRun run;  // but for what was taken
  std::size_t samples_taken = 0;
  std::optional<TimedPose> last_truth;
  std::vector<double> readings;  // of one sample
  std::vector<GaugeShape> gauges;
  VehiclePosture posture;                 // at the last sample
  std::vector<GaugeReading> gauges_read;  // in it
  Track exact, estimated;
  bool keeps_tracks = true;
  Pose measured_start, measured_end;
};

Simulation::Simulation(const Scenario& scenario, std::uint64_t seed, std::shared_ptr<const Recording> replayed,
                       const std::vector<std::shared_ptr<planar::Effect>>& own)
    : parts_(std::make_unique<Parts>(scenario, seed, std::move(replayed), own)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::step() {
  if (!parts_->state.finished) parts_->step();
}

const SimulationState& Simulation::state() const { return parts_->state; }
double Simulation::expected_duration_s() const { return parts_->duration_s; }

void Simulation::set_floor(const Floor& floor) {
  parts_->scenario.floor = floor;
  parts_->ground = Ground(parts_->effects.laid_on(floor), inside_of(parts_->scenario.path), parts_->floor_seed);
}

VehicleShape Simulation::shape() const { return parts_->vehicle->shape(); }

VehiclePosture Simulation::posture() const {
  const Parts& parts = *parts_;
  VehiclePosture posture;
  posture.reference = parts.state.true_pose;
  parts.vehicle->pose_parts(posture);
  posture.gauges = parts.gauges_read;
  return posture;
}

Pose Simulation::driven_start() const { return parts_->driven_start; }
std::size_t Simulation::samples() const { return parts_->samples_taken + parts_->run.time_s.size(); }
const std::vector<std::string>& Simulation::channels() const { return parts_->run.channels; }
const std::vector<double>& Simulation::readings() const { return parts_->readings; }

void Simulation::drive_by_hand(double speed_mps, double yaw_rate_radps, double sideways_mps) {
  parts_->hand = {speed_mps, yaw_rate_radps, sideways_mps};
}
void Simulation::push(Vec2 impulse_ns) { parts_->vehicle->push(impulse_ns); }

void Simulation::keep_no_tracks() {
  parts_->keeps_tracks = false;
  parts_->exact.erase(parts_->exact.begin(), parts_->exact.end() - 1);
  parts_->estimated.erase(parts_->estimated.begin(), parts_->estimated.end() - 1);
}
const Track& Simulation::true_track() const { return parts_->exact; }
const Track& Simulation::estimated_track() const { return parts_->estimated; }
Pose Simulation::measured_start() const { return parts_->measured_start; }
Pose Simulation::measured_end() const { return parts_->measured_end; }

TruthMounting Simulation::truth_mounting() const { return parts_->mounting; }

SampledRun Simulation::take_samples() {
  SampledRun& run = parts_->run;
  parts_->samples_taken += run.time_s.size();
  SampledRun rest;
  rest.channels = run.channels;
  return std::exchange(run, std::move(rest));
}

Recording Simulation::recording(SampledRun run) const {
  const Parts& parts = *parts_;
  const bool offset = parts.mounting.time_offset_s != parts.scenario.vehicle.truth.time_offset_s;
  const auto append = [](auto& all, const auto& last) { all.insert(all.end(), last.begin(), last.end()); };
  run.channels = parts.run.channels;
  append(run.time_s, parts.run.time_s);
  append(run.readings, parts.run.readings);
  append(run.commands, parts.run.commands);
  append(run.truth, parts.run.truth);
  if (!parts.effects.empty())
    for (double& time_s : run.time_s) time_s = parts.effects.robot_stamp_s(parts.begin_s, time_s - parts.begin_s);
  if (offset)
    for (TimedPose& t : run.truth)
      t.time_s += parts.mounting.time_offset_s - parts.scenario.vehicle.truth.time_offset_s;
  return recording_of(run, parts.scenario.sensors, parts.scenario.name);
}

void run_to_end(Simulation& simulation, double longest_s) {
  const double end_s = simulation.state().time_s + longest_s;
  while (!simulation.state().finished && simulation.state().time_s < end_s) simulation.step();
}

}  // namespace odolab
