#include "physics/vehicles/planar_differential_drive.h"

#include "core/base/random.h"
#include "core/odometry/differential_drive.h"
#include "physics/vehicles/axle_commands.h"

namespace odolab {

PlanarDifferentialDrive::PlanarDifferentialDrive(const VehicleSetup& setup, const ActualDrive& actual)
    : nominal_(std::get<DifferentialDrive>(setup.scenario.vehicle.kind)),
      actual_(actual),
      step_s_(setup.scenario.step_s),
      world_(step_s_),
      body_(world_.add_body({setup.start, actual.mass_kg, actual.moment_of_inertia_kgm2})),
      axle_(world_, body_, {}, actual, setup.scenario.motor, step_s_, setup.effects),
      effects_(&setup.effects),
      left_encoder_(nominal_.counts_per_wheel_turn(), 0.0),
      right_encoder_(nominal_.counts_per_wheel_turn(), 0.0),
      believed_(setup.start) {
  Random phases(setup.sensor_seed);
  left_encoder_ = Encoder(nominal_.counts_per_wheel_turn(), phases.uniform());
  right_encoder_ = Encoder(nominal_.counts_per_wheel_turn(), phases.uniform());
}

void PlanarDifferentialDrive::drive(const Ground& ground, const Floor& floor, const CommandRamp& command) {
  drive_wheels(ground, floor,
               between(wheel_speeds(command.before, nominal_), wheel_speeds(command.next, nominal_), command.share));
}

void PlanarDifferentialDrive::drive_wheels(const Ground& ground, const Floor& floor, WheelPair set) {
  for (const auto& effect : *effects_) effect->command(set);
  axle_.turn_motors(set);
  step(ground, floor);
}

void PlanarDifferentialDrive::turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds) {
  axle_.turn_exactly({speeds[0], speeds[1]});
  step(ground, floor);
}

void PlanarDifferentialDrive::step(const Ground& ground, const Floor& floor) {
  axle_.before_step(ground, floor);
  pull_downhill(world_, body_, actual_.mass_kg, floor);
  world_.step();
  axle_.after_step();
}

void PlanarDifferentialDrive::begin_in_motion(const std::vector<double>& speeds) {
  const double left_mps = actual_.wheel_radius_left_m * speeds[0], right_mps = actual_.wheel_radius_right_m * speeds[1];
  const Vec2 velocity = rotated({0.5 * (left_mps + right_mps), 0.0}, world_.pose(body_).heading_rad);
  world_.set_velocity(body_, velocity, (right_mps - left_mps) / actual_.wheelbase_m);
}

BaseCommand PlanarDifferentialDrive::motion_of(WheelPair speed) const {
  const double left_mps = speed.left * nominal_.wheel_radius_left_m,
               right_mps = speed.right * nominal_.wheel_radius_right_m;
  return {0.5 * (left_mps + right_mps), (right_mps - left_mps) / nominal_.wheelbase_m};
}

void PlanarDifferentialDrive::push(Vec2 impulse_ns) { world_.apply_force(body_, (1.0 / step_s_) * impulse_ns); }

double PlanarDifferentialDrive::speed_mps() const {
  const double heading = world_.pose(body_).heading_rad;
  return dot(world_.velocity_mps(body_), {std::cos(heading), std::sin(heading)});
}

VehicleShape PlanarDifferentialDrive::shape() const {
  VehicleShape shape;
  const DifferentialDrive wheels{actual_.wheel_radius_left_m, actual_.wheel_radius_right_m, actual_.wheelbase_m};
  add_drive_shape(shape, wheels, "", actual_.toe_left_rad, actual_.toe_right_rad);
  return shape;
}

void PlanarDifferentialDrive::pose_parts(VehiclePosture& posture) const {
  posture.bodies = {world_.pose(body_)};
  posture.wheels = {left(), right()};
}

void PlanarDifferentialDrive::sample(double time_s, std::vector<double>& readings) {
  WheelPair now{left_encoder_.reading_rad(left().counted_rad), right_encoder_.reading_rad(right().counted_rad)};
  for (const auto& effect : *effects_) {
    effect->read_encoder(Side::left, time_s, now.left);
    effect->read_encoder(Side::right, time_s, now.right);
  }
  if (read_) believed_ = dead_reckoned(believed_, now.left - read_->left, now.right - read_->right, nominal_);
  read_ = now;
  readings = {now.left, now.right};
}

std::unique_ptr<PlanarVehicle> make_differential_drive(const VehicleSetup& setup) {
  if (!std::holds_alternative<DifferentialDrive>(setup.scenario.vehicle.kind)) return nullptr;
  return std::make_unique<PlanarDifferentialDrive>(setup, setup.effects.built_into(setup.scenario.actual));
}

}  // namespace odolab
