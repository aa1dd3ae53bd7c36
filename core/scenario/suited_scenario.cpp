#include "core/scenario/suited_scenario.h"

#include <algorithm>

namespace odolab {

namespace {

// What a kind is driven like. Weights and speeds are those of our scenarios; assumptions where no report gives them.
struct Suit {
  Scenario* s;

  void operator()(const DifferentialDrive&) const {}
  void operator()(const SynchroDrive&) const {
    s->actual.mass_kg = 125.0;
    s->actual.moment_of_inertia_kgm2 = 8.0;
  }
  void operator()(const Tracked&) const { with_tracks(); }
  void operator()(const EncoderTrailer&) const { with_tracks(); }
  void operator()(const SmartEncoderTrailer&) const { s->sensors.encoder_period_s = 0.04; }
  void operator()(const LinkedTrucks&) const {  // CLAPPER paper, section 6
    s->sensors.encoder_period_s = 0.04;
    s->driving.turn_rate_radps = 0.4;
    s->driving.turn_acceleration_radps2 = 0.3;
  }
  void operator()(const MultiCastor&) const { s->sensors.encoder_period_s = 0.05; }

  // Skidding takes more torque than a LabMate's motors have, and a driver who sees where the vehicle is.
  void with_tracks() const {
    s->actual.mass_kg = 200.0;
    s->actual.moment_of_inertia_kgm2 = 20.0;
    s->motor.ideal = true;
    s->driving.by_eye = true;
  }
};

bool fits(const Path& path, const VehicleKind& kind) {
  if (std::holds_alternative<WheelSpeedPath>(path)) return std::holds_alternative<DifferentialDrive>(kind);
  if (std::holds_alternative<ReplayPath>(path)) return false;  // a recording is of one kind of vehicle
  const auto* manoeuvres = std::get_if<ManoeuvrePath>(&path);
  return !manoeuvres || moves_sideways(kind) ||
         std::all_of(manoeuvres->moves.begin(), manoeuvres->moves.end(),
                     [](const Manoeuvre& move) { return move.left_m == 0.0; });
}

}  // namespace

Motor usual_motor(const VehicleKind& kind) {
  Motor motor;
  if (std::holds_alternative<Tracked>(kind) || std::holds_alternative<EncoderTrailer>(kind))
    motor.torque_limit_nm = 100.0;
  return motor;
}

Scenario with_vehicle(Scenario scenario, const Vehicle& vehicle) {
  const bool same_kind = scenario.vehicle.kind.index() == vehicle.kind.index();
  scenario.vehicle = vehicle;
  scenario.vehicle_file.clear();
  scenario.machine.lengths.reset();
  if (!same_kind) {
    const Scenario plain;
    scenario.name = vehicle.name;
    scenario.about.clear();
    scenario.expectations.clear();
    scenario.machine = {};
    scenario.effects.clear();
    scenario.actual = plain.actual;
    scenario.motor = usual_motor(vehicle.kind);
    scenario.driving = plain.driving;
    scenario.sensors.encoder_period_s = std::max(plain.sensors.encoder_period_s, scenario.step_s);
    if (!std::holds_alternative<DifferentialDrive>(vehicle.kind)) scenario.benchmark.reset();
    std::visit(Suit{&scenario}, vehicle.kind);
  }
  const bool still_replays = same_kind && std::holds_alternative<ReplayPath>(scenario.path);
  if (!still_replays && !fits(scenario.path, vehicle.kind)) scenario.path = SquarePath{};
  if (const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind)) {
    const ActualDrive drawn = as_drawn(*drive);
    scenario.actual.wheel_radius_left_m = drawn.wheel_radius_left_m;
    scenario.actual.wheel_radius_right_m = drawn.wheel_radius_right_m;
    scenario.actual.wheelbase_m = drawn.wheelbase_m;
  }
  return scenario;
}

}  // namespace odolab
