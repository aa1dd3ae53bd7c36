#include "physics/experiments/guide_drives.h"

#include <algorithm>

#include "core/base/random.h"
#include "core/recording/vehicle_samples.h"
#include "physics/driven_recording.h"
#include "physics/experiments/castor_prototype.h"
#include "physics/simulation.h"

namespace odolab {

namespace {

constexpr double kPatience = 3.0;  // times the planned duration, then it counts as lost

// False where it never arrived.
bool drive_to_end(Simulation& simulation, const Progress& progress) {
  const double expected_s = std::max(1.0, simulation.expected_duration_s());
  for (long k = 0; !simulation.state().finished && simulation.state().time_s < kPatience * expected_s; ++k) {
    simulation.step();
    if (k % 1000 == 0 && !goes_on(progress, simulation.state().time_s / expected_s)) return false;
  }
  return simulation.state().finished;
}

Clapper drawn_clapper(const Clapper& nominal, std::uint64_t seed) {
  Random random(seed);
  Clapper actual = nominal;
  actual.link_angle_a_offset_rad += random.uniform(-0.015, 0.015);
  actual.link_angle_b_offset_rad += random.uniform(-0.015, 0.015);
  actual.link_length_offset_m += random.uniform(-0.003, 0.003);
  for (DifferentialDrive* truck : {&actual.truck_a, &actual.truck_b}) {
    truck->wheelbase_m *= 1.0 + random.uniform(-0.01, 0.01);
    truck->wheel_radius_right_m *= 1.0 + random.uniform(-0.0015, 0.0015);
  }
  return actual;
}

Scenario driven_as(const Vehicle& nominal, const Vehicle& actual, const Path& path) {
  Scenario scenario;
  scenario.name = nominal.name;
  scenario.vehicle = nominal;
  scenario.machine.lengths = actual.kind;
  scenario.path = path;
  scenario.driving = {0.35, 0.35, 0.2, 0.3};
  scenario.sensors.encoder_period_s = scenario.sensors.truth_period_s = 0.04;
  return scenario;
}

}  // namespace

Vehicle drawn_machine(const Vehicle& nominal, std::uint64_t seed) {
  Vehicle actual = nominal;
  if (const auto* castors = std::get_if<MultiCastor>(&nominal.kind))
    actual.kind = drawn_castor_machine(*castors, seed, true);
  else if (const auto* clapper = std::get_if<Clapper>(&nominal.kind))
    actual.kind = drawn_clapper(*clapper, seed);
  return actual;
}

std::optional<TapeReading> drive_along_tape(const Scenario& scenario, double length_m, double tape_accuracy_m,
                                            std::uint64_t seed, const Progress& progress) {
  Scenario straight = scenario;
  straight.path = StraightPath{length_m, false};
  straight.benchmark.reset();
  straight.floor.bumps.clear();
  straight.floor.slip_zones.clear();
  Simulation simulation(straight, seed);
  if (!drive_to_end(simulation, progress)) return std::nullopt;
  Random tape(seed_of_stream(seed, 1));
  const auto from_start = [&](const Pose& pose) { return length(between(straight.start, pose).position()); };
  return TapeReading{from_start(simulation.state().estimated_pose),
                     from_start(simulation.state().true_pose) + tape_accuracy_m * tape.normal(), tape_accuracy_m};
}

std::vector<Bump> ten_cables(double side_m) {
  std::vector<Bump> cables;
  for (int k = 1; k <= 10; ++k) {
    Bump cable;
    cable.centre = {0.09 * k * side_m, 0.0};
    cable.length_m = 1.5;
    cable.height_m = 0.010;
    cable.under = Under::inside_wheel;
    cables.push_back(cable);
  }
  return cables;
}

Scenario on_guide_square(const Scenario& scenario, double side_m, int runs_each_way) {
  Scenario square = scenario;
  square.path = SquarePath{side_m, false};
  square.start = {};
  square.floor.bumps.clear();
  square.floor.slip_zones.clear();
  square.benchmark = Benchmark{runs_each_way, false};
  if (square.sensors.truth_position_noise_m == 0.0) square.sensors.truth_position_noise_m = 0.002;
  if (square.sensors.truth_heading_noise_rad == 0.0) square.sensors.truth_heading_noise_rad = radians(0.4);
  return square;
}

InsideDrives drive_for_calibration_from_inside(const Vehicle& nominal, std::uint64_t seed, const Progress& progress) {
  InsideDrives drives;
  drives.actual = drawn_machine(nominal, seed);
  if (const auto* castors = std::get_if<MultiCastor>(&nominal.kind)) {
    const MultiCastor& actual = std::get<MultiCastor>(drives.actual.kind);
    constexpr double kSweep_rad = 1.6;
    int number = 0;
    for (const std::vector<CastorSample>& samples : calibration_drives(actual, *castors, kSweep_rad, mixed(seed))) {
      drives.recordings.push_back(recording_of(samples));
      drives.recordings.back().name =
          "castor " + std::to_string(number / 2 + 1) + (number % 2 == 0 ? " still, cw" : " still, ccw");
      drives.recordings.back().provenance = "simulated: kinematics";
      ++number;
    }
  } else if (std::holds_alternative<Clapper>(nominal.kind)) {
    const ManoeuvrePath moves{
        {{2.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}, {0.0, 0.0, 0.5 * kPi}, {-1.0, 0.0, 0.0}}};
    const std::pair<const char*, Path> paths[] = {{"rectangle", RectanglePath{7.0, 4.0, 0.48, false}},
                                                  {"manoeuvres", moves}};
    int done = 0;
    for (const auto& [name, path] : paths) {
      const int before = done;
      const auto recording =
          driven_recording(driven_as(nominal, drives.actual, path), seed_of_stream(seed, 10 + done),
                           [&progress, before](double share) { return goes_on(progress, 0.5 * (before + share)); });
      if (!recording) return {};
      ++done;
      drives.recordings.push_back(*recording);
      drives.recordings.back().name = name;
    }
  }
  return drives;
}

std::optional<Recording> drive_held_out(const Vehicle& believed, const Vehicle& actual, std::uint64_t seed,
                                        const Progress& progress) {
  const ManoeuvrePath way{{{1.5, 0.0, 0.5 * kPi}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.5 * kPi}, {-1.0, 0.0, 0.0}}};
  auto recording = driven_recording(driven_as(believed, actual, way), seed_of_stream(seed, 20), progress);
  if (recording) recording->name = "another way";
  return recording;
}

}  // namespace odolab
