// A synchro drive on the floor: a base on three wheels that one motor turns and another steers, all alike. Where the
// wheels do not agree, the floor decides which of them slips: the solver, by Coulomb's law and the rubber's creep. The
// base keeps its direction but for what the wheels' quarrels turn it by.
#include <algorithm>
#include <array>
#include <optional>

#include "core/base/random.h"
#include "core/odometry/synchro_step.h"
#include "physics/sensors/encoder.h"
#include "physics/vehicles/axle_commands.h"
#include "physics/vehicles/planar_vehicle.h"

namespace odolab {

namespace {

constexpr double kSoftSlip_mps = 0.02e-3;  // creep follows forces, and rigid wheels have none of their own

class PlanarSynchroDrive final : public PlanarVehicle {
 public:
  PlanarSynchroDrive(const VehicleSetup& setup, const SynchroDrive& nominal, const SynchroDrive& actual)
      : nominal_(nominal),
        actual_(actual),
        wheels_as_built_(setup.scenario.machine.synchro),
        mass_kg_(setup.scenario.actual.mass_kg),
        step_s_(setup.scenario.step_s),
        world_(step_s_, Friction::in_every_step),
        body_(world_.add_body({setup.start, mass_kg_, setup.scenario.actual.moment_of_inertia_kgm2})),
        start_heading_rad_(setup.start.heading_rad),
        motor_(world_.add_drive(body_)),
        drive_(setup.scenario.motor, actual.wheel_radius_m, mass_kg_ * actual.wheel_radius_m * actual.wheel_radius_m),
        steering_(setup.scenario.motor, 1.0, 0.0),
        believed_{setup.start, setup.start.heading_rad} {
    world_.soften_friction(kSoftSlip_mps);
    Random phases(setup.sensor_seed);
    drive_encoder_ = Encoder(nominal.drive_counts_per_revolution, phases.uniform());
    steering_encoder_ = Encoder(nominal.steering_counts_per_revolution, phases.uniform());
    constexpr Side kSides[] = {Side::middle, Side::left, Side::right};
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const double angle_rad = 2.0 * kPi / 3.0 * static_cast<double>(i);
      Wheel& wheel = wheels_[i];
      wheel.side = kSides[i];
      wheel.place = rotated({wheels_as_built_.wheel_circle_radius_m, 0.0}, angle_rad);
      wheel.tread = world_.add_tread(body_, wheel.place);
    }
  }

  void drive(const Ground& ground, const Floor& floor, const CommandRamp& command) override {
    const double yaw_radps =
        command.before.yaw_rate_radps + command.share * (command.next.yaw_rate_radps - command.before.yaw_rate_radps);
    const double speed_mps =
        command.before.speed_mps + command.share * (command.next.speed_mps - command.before.speed_mps);
    double traction_n = 0.0;
    for (const Wheel& wheel : wheels_) traction_n += wheel.state.traction_n;
    const double steered_rad = steering_.rotation_rad();
    steering_.advance(nominal_.steering_ratio * yaw_radps, 0.0, step_s_);
    if (steering_.unloaded().inertia_kgm2 >
        0.0)  // nothing resists it: what the turret weighs is in the motor's inertia
      steering_.settle_at(steering_.unloaded().speed_radps);
    const double rolling_radps = drive_.advance(
        speed_mps / nominal_.wheel_radius_m + nominal_.wheel_rad_per_steering_rad * yaw_radps, traction_n, step_s_);
    step(ground, floor, rolling_radps, steered_rad);
  }
  std::vector<std::string> turned_channels() const override { return channels(); }
  void turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds) override {
    const double steered_rad = steering_.rotation_rad();
    drive_.turn_at(speeds[0], step_s_);
    steering_.turn_at(speeds[1], step_s_);
    step(ground, floor, speeds[0], steered_rad);
  }
  void begin_in_motion(const std::vector<double>& speeds) override {
    set_in_motion(world_, body_, {rotated({actual_.wheel_radius_m * speeds[0], 0.0}, pose().heading_rad), 0.0});
  }
  // `steered_rad` as it was before this step.
  void step(const Ground& ground, const Floor& floor, double rolling_radps, double steered_rad) {
    set_treads(ground, floor, rolling_radps, 0.5 * (steered_rad + steering_.rotation_rad()) / actual_.steering_ratio);
    pull_downhill(world_, body_, mass_kg_, floor);
    world_.step();
    if (drive_.unloaded().inertia_kgm2 > 0.0) {
      const double change_mps = world_.drive_change_mps(motor_);
      rolling_radps += change_mps / actual_.wheel_radius_m;
      drive_.settle_at(rolling_radps);
      for (Wheel& wheel : wheels_) wheel.rolled_mps += change_mps * wheel.share_of_drive;
    }
    look_at_treads(rolling_radps);
  }

  void push(Vec2 impulse_ns) override { world_.apply_force(body_, (1.0 / step_s_) * impulse_ns); }
  void set_clock(double) override {}  // nor effects

  Pose pose() const override {
    const Pose& base = world_.pose(body_);
    return {base.x_m, base.y_m, base.heading_rad + wheel_direction_rad()};
  }
  double speed_mps() const override {
    const double heading = pose().heading_rad;
    return dot(world_.velocity_mps(body_), {std::cos(heading), std::sin(heading)});
  }
  double yaw_rate_radps() const override {
    return world_.yaw_rate_radps(body_) + steering_.speed_radps() / actual_.steering_ratio;
  }
  WheelState left() const override { return wheels_[1].state; }
  WheelState right() const override { return wheels_[2].state; }

  VehicleShape shape() const override {
    VehicleShape shape;
    const double circle_m = wheels_as_built_.wheel_circle_radius_m;
    shape.bodies.push_back({round_outline(circle_m + 0.8 * actual_.wheel_radius_m), false});
    const char* kNames[] = {"front", "rear left", "rear right"};
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const double radius_m = actual_.wheel_radius_m * (1.0 + wheels_as_built_.radius_error[i]);
      shape.wheels.push_back({kNames[i], 0, wheels_[i].place, wheels_as_built_.misalignment_rad[i], radius_m,
                              std::min(0.4 * radius_m, 0.5 * circle_m), 0.0});
    }
    shape.gauges = {{"steering", "steering_rad", false}, {"base turned", "", false}};
    return shape;
  }
  void pose_parts(VehiclePosture& posture) const override {
    posture.bodies = {world_.pose(body_)};
    posture.wheels.clear();
    for (const Wheel& wheel : wheels_) {
      posture.wheels.push_back(wheel.state);
      posture.wheels.back().steered_rad = wheel_direction_rad();
    }
    posture.gauges = {{wheel_direction_rad(), 0.0}, {world_.pose(body_).heading_rad - start_heading_rad_, 0.0}};
  }

  std::vector<std::string> channels() const override { return {"drive_wheel_rad", "steering_rad"}; }
  void sample(double /*time_s*/, std::vector<double>& readings) override {
    const double wheel_rad = drive_encoder_.reading_rad(drive_.rotation_rad());
    const double steering_rad = steering_encoder_.reading_rad(steering_.rotation_rad());
    if (read_)
      believed_ = dead_reckoned(believed_, wheel_rad - read_->wheel_rad, steering_rad - read_->steering_rad, nominal_);
    read_ = Reading{wheel_rad, steering_rad};
    readings = {wheel_rad, steering_rad};
  }
  Pose believed() const override { return believed_.pose; }

 private:
  struct Wheel {
    Side side = Side::middle;
    Vec2 place;  // in the base's frame
    int tread = 0;
    Vec2 direction{1.0, 0.0};  // in the base's frame
    double rolled_mps = 0.0;
    double share_of_drive = 1.0;  // of what the drive motor rolls
    double travelled_m = 0.0;
    Vec2 creep_mps;  // in the base's frame: of the contact against what the wheel rolls
    WheelState state{};
  };
  struct Reading {
    double wheel_rad = 0.0;
    double steering_rad = 0.0;
  };

  double wheel_direction_rad() const { return steering_.rotation_rad() / actual_.steering_ratio; }
  double wheel_load_n() const { return mass_kg_ * kGravity_mps2 / 3.0; }

  void set_treads(const Ground& ground, const Floor& floor, double rolling_radps, double direction_rad) {
    const WheelDrive::Unloaded unloaded = drive_.unloaded();
    if (unloaded.inertia_kgm2 > 0.0)
      world_.set_drive(motor_, unloaded.inertia_kgm2 / (actual_.wheel_radius_m * actual_.wheel_radius_m),
                       actual_.wheel_radius_m * (unloaded.speed_radps - rolling_radps));
    const Pose& base = world_.pose(body_);
    const double heading_rad = base.heading_rad + 0.5 * step_s_ * world_.yaw_rate_radps(body_);
    const Vec2 centre = base.position() + (0.5 * step_s_) * world_.velocity_mps(body_);
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      Wheel& wheel = wheels_[i];
      const double radius_m = actual_.wheel_radius_m * (1.0 + wheels_as_built_.radius_error[i]);
      const double in_base_rad = direction_rad + wheels_as_built_.misalignment_rad[i];
      wheel.direction = {std::cos(in_base_rad), std::sin(in_base_rad)};
      const Contact contact =
          ground.under({wheel.side, centre + rotated(wheel.place, heading_rad), heading_rad + in_base_rad, radius_m,
                        wheel.travelled_m, static_cast<int>(i)});
      wheel.rolled_mps = radius_m * rolling_radps * contact.horizontal_share * (1.0 - contact.slip);
      wheel.share_of_drive = radius_m / actual_.wheel_radius_m * contact.horizontal_share * (1.0 - contact.slip);
      wheel.travelled_m += wheel.rolled_mps * step_s_;
      world_.set_tread(wheel.tread, wheel.rolled_mps * wheel.direction - wheel.creep_mps,
                       contact.friction * wheel_load_n() * std::cos(floor.tilt_rad));
      if (drive_.unloaded().inertia_kgm2 > 0.0)
        world_.set_tread_drive(wheel.tread, motor_, wheel.share_of_drive * wheel.direction);
      wheel.state.on_bump = contact.on_bump;
      wheel.state.in_slip_zone = contact.in_slip_zone;
    }
  }

  // Traction, and the creep that it makes in the next step: slip = force / (stiffness load) of the speed, reached over
  // the relaxation length.
  void look_at_treads(double rolling_radps) {
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      Wheel& wheel = wheels_[i];
      const Vec2 force_n = world_.tread_force_n(wheel.tread);
      if (wheels_as_built_.creep_stiffness > 0.0) {
        const double speed_mps = std::abs(wheel.rolled_mps);
        const double settled = speed_mps / (wheels_as_built_.creep_stiffness * wheel_load_n());
        const double share = 1.0 - std::exp(-speed_mps * step_s_ / wheels_as_built_.relaxation_length_m);
        wheel.creep_mps = wheel.creep_mps + share * (settled * force_n - wheel.creep_mps);
      }
      wheel.state.rotation_rad = wheel.state.counted_rad = drive_.rotation_rad();
      wheel.state.speed_radps = rolling_radps;
      wheel.state.traction_n = dot(force_n, wheel.direction);
      const Vec2 over_floor = world_.velocity_of_point_mps(body_, wheel.place);
      wheel.state.slip_speed_mps = wheel.rolled_mps - dot(over_floor, wheel.direction);
    }
  }

  SynchroDrive nominal_, actual_;
  ActualSynchroWheels wheels_as_built_;
  double mass_kg_;
  double step_s_;
  PlanarWorld world_;
  int body_;
  double start_heading_rad_;
  int motor_;  // the drive's, in the world
  WheelDrive drive_, steering_;
  std::array<Wheel, 3> wheels_;
  Encoder drive_encoder_{1.0, 0.0}, steering_encoder_{1.0, 0.0};
  std::optional<Reading> read_;  // last
  SynchroPose believed_;
};

}  // namespace

std::unique_ptr<PlanarVehicle> make_synchro_drive(const VehicleSetup& setup) {
  const auto* nominal = std::get_if<SynchroDrive>(&setup.scenario.vehicle.kind);
  if (!nominal) return nullptr;
  return std::make_unique<PlanarSynchroDrive>(
      setup, *nominal, true_lengths<SynchroDrive>(setup.scenario.machine, setup.scenario.vehicle));
}

}  // namespace odolab
