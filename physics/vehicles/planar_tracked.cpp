// A tracked vehicle on the floor: one body on two tracks, steered by their difference.
#include <optional>

#include "core/base/random.h"
#include "core/odometry/differential_drive.h"
#include "physics/sensors/encoder.h"
#include "physics/vehicles/axle_commands.h"
#include "physics/vehicles/pair_of_tracks.h"
#include "physics/vehicles/planar_vehicle.h"

namespace odolab {

namespace {

class PlanarTracked final : public PlanarVehicle {
 public:
  PlanarTracked(const VehicleSetup& setup, const Tracked& nominal, const Tracked& actual)
      : nominal_(as_differential_drive(nominal)),
        sprockets_(as_differential_drive(actual)),
        contact_length_m_(setup.scenario.machine.tracks.contact_length_m),
        mass_kg_(setup.scenario.actual.mass_kg),
        tracks_middle_{-setup.scenario.machine.tracks.centre_of_mass_x_m, 0.0, 0.0},
        step_s_(setup.scenario.step_s),
        world_(step_s_, Friction::in_every_step),
        body_(world_.add_body(
            {setup.start * inverse(tracks_middle_), mass_kg_, setup.scenario.actual.moment_of_inertia_kgm2})),
        tracks_(world_, body_, sprockets_, setup.scenario.machine.tracks, setup.scenario.actual, setup.scenario.motor,
                step_s_),
        believed_(setup.start) {
    Random phases(setup.sensor_seed);
    left_encoder_ = Encoder(nominal_.counts_per_wheel_turn(), phases.uniform());
    right_encoder_ = Encoder(nominal_.counts_per_wheel_turn(), phases.uniform());
  }

  void drive(const Ground& ground, const Floor& floor, const CommandRamp& command) override {
    tracks_.turn_motors(
        between(wheel_speeds(command.before, nominal_), wheel_speeds(command.next, nominal_), command.share));
    step(ground, floor);
  }
  std::vector<std::string> turned_channels() const override { return channels(); }
  void turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds) override {
    tracks_.turn_exactly({speeds[0], speeds[1]});
    step(ground, floor);
  }
  // Tracks skid in turns: the turn is the one that the nominal vehicle takes it for.
  void begin_in_motion(const std::vector<double>& speeds) override {
    const BodyVelocity motion = rolling_motion(pose(), nominal_, {speeds[0], speeds[1]});
    set_in_motion(world_, body_, {motion.at(world_.pose(body_).position() - pose().position()), motion.yaw_rate_radps});
  }
  void step(const Ground& ground, const Floor& floor) {
    tracks_.before_step(ground, floor);
    pull_downhill(world_, body_, mass_kg_, floor);
    world_.step();
    tracks_.after_step();
  }
  void push(Vec2 impulse_ns) override { world_.apply_force(body_, (1.0 / step_s_) * impulse_ns); }
  void set_clock(double) override {}  // tracks have no effects

  Pose pose() const override { return world_.pose(body_) * tracks_middle_; }
  double speed_mps() const override { return world_.velocity_of_point_mps(body_, {}).x_m; }
  double yaw_rate_radps() const override { return world_.yaw_rate_radps(body_); }
  WheelState left() const override { return tracks_.left(); }
  WheelState right() const override { return tracks_.right(); }

  VehicleShape shape() const override {
    VehicleShape shape;
    add_tracked_shape(shape, sprockets_, contact_length_m_, tracks_middle_.x_m);
    return shape;
  }
  void pose_parts(VehiclePosture& posture) const override {
    posture.bodies = {world_.pose(body_)};
    posture.wheels = {left(), right()};
  }

  std::vector<std::string> channels() const override { return {"left_wheel_rad", "right_wheel_rad"}; }
  void sample(double /*time_s*/, std::vector<double>& readings) override {
    const WheelPair now{left_encoder_.reading_rad(left().counted_rad), right_encoder_.reading_rad(right().counted_rad)};
    if (read_) believed_ = dead_reckoned(believed_, now.left - read_->left, now.right - read_->right, nominal_);
    read_ = now;
    readings = {now.left, now.right};
  }
  Pose believed() const override { return believed_; }

 private:
  DifferentialDrive nominal_;    // whose dead reckoning the vehicle's is
  DifferentialDrive sprockets_;  // true radii, and the tracks' distance as wheelbase
  double contact_length_m_;
  double mass_kg_;
  Pose tracks_middle_;  // in the frame of the centre of mass
  double step_s_;
  PlanarWorld world_;
  int body_;
  PairOfTracks tracks_;
  Encoder left_encoder_{1.0, 0.0}, right_encoder_{1.0, 0.0};
  std::optional<WheelPair> read_;  // last
  Pose believed_;
};

}  // namespace

std::unique_ptr<PlanarVehicle> make_tracked(const VehicleSetup& setup) {
  const auto* nominal = std::get_if<Tracked>(&setup.scenario.vehicle.kind);
  if (!nominal) return nullptr;
  return std::make_unique<PlanarTracked>(setup, *nominal,
                                         true_lengths<Tracked>(setup.scenario.machine, setup.scenario.vehicle));
}

}  // namespace odolab
