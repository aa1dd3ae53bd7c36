// A tracked vehicle that tows the Basic Encoder Trailer: a second body, pinned to the first at the hitch, on two wheels
// that roll freely and only count. Pushed backwards it swivels round its hitch like a castor, and leads.
#include <optional>

#include "core/base/random.h"
#include "core/odometry/differential_drive.h"
#include "core/odometry/encoder_trailer.h"
#include "core/scenario/effect_catalogue.h"
#include "physics/sensors/absolute_encoder.h"
#include "physics/sensors/encoder.h"
#include "physics/sensors/slip_ring.h"
#include "physics/vehicles/axle_commands.h"
#include "physics/vehicles/free_axle.h"
#include "physics/vehicles/pair_of_tracks.h"
#include "physics/vehicles/planar_vehicle.h"

namespace odolab {

namespace {

constexpr int kTrailerAxle = 1;  // whose roughness it meets

double hitch_at_start_rad(const VehicleSetup& setup, const EncoderTrailer& lengths) {
  return setup.first_readings.empty() ? 0.0 : setup.first_readings[4] - lengths.hitch_angle_offset_rad;
}

class PlanarEncoderTrailer final : public PlanarVehicle {
 public:
  PlanarEncoderTrailer(const VehicleSetup& setup, const EncoderTrailer& nominal, const EncoderTrailer& actual)
      : nominal_(nominal),
        actual_(actual),
        masses_(setup.scenario.machine.trailer),
        tow_mass_kg_(setup.scenario.actual.mass_kg),
        contact_length_m_(setup.scenario.machine.tracks.contact_length_m),
        tracks_middle_{-setup.scenario.machine.tracks.centre_of_mass_x_m, 0.0, 0.0},
        step_s_(setup.scenario.step_s),
        world_(step_s_, Friction::in_every_step),
        body_(world_.add_body(
            {setup.start * inverse(tracks_middle_), tow_mass_kg_, setup.scenario.actual.moment_of_inertia_kgm2})),
        towed_(world_.add_body({setup.start * Pose{-actual.hitch_offset_m, 0.0, -hitch_at_start_rad(setup, actual)} *
                                    Pose{-actual.drawbar_length_m, 0.0, 0.0},
                                masses_.mass_kg, masses_.moment_of_inertia_kgm2})),
        tracks_(world_, body_, actual.tow, setup.scenario.machine.tracks, setup.scenario.actual, setup.scenario.motor,
                step_s_),
        effects_(effects_of_part(setup.scenario.effects, "trailer"), {setup.scenario.actual, step_s_}),
        slip_ring_(setup.scenario.machine.slip_ring.bursts_per_s, setup.scenario.machine.slip_ring.largest_burst_counts,
                   seed_of_stream(setup.sensor_seed, 1)),
        hitch_noise_(seed_of_stream(setup.sensor_seed, 2)),
        believed_(setup.start) {
    world_.add_pin(
        {body_, towed_, tracks_middle_ * Vec2{-actual.hitch_offset_m, 0.0}, Vec2{actual.drawbar_length_m, 0.0}});
    Random phases(setup.sensor_seed);
    left_encoder_ = Encoder(nominal_.tow.counts_per_wheel_turn(), phases.uniform());
    right_encoder_ = Encoder(nominal_.tow.counts_per_wheel_turn(), phases.uniform());
    axle_.emplace(world_, towed_, actual.trailer, nominal.trailer.counts_per_wheel_turn(), kTrailerAxle, effects_,
                  step_s_, phases);
  }

  void drive(const Ground& ground, const Floor& floor, const CommandRamp& command) override {
    tracks_.turn_motors(
        between(wheel_speeds(command.before, nominal_.tow), wheel_speeds(command.next, nominal_.tow), command.share));
    step(ground, floor);
  }
  std::vector<std::string> turned_channels() const override { return {"left_wheel_rad", "right_wheel_rad"}; }
  void turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds) override {
    tracks_.turn_exactly({speeds[0], speeds[1]});
    step(ground, floor);
  }
  // Tracks skid in turns: the turn is the one that the nominal vehicle takes it for.
  void begin_in_motion(const std::vector<double>& speeds) override {
    const Pose middle = pose();
    const BodyVelocity tow = rolling_motion(middle, nominal_.tow, {speeds[0], speeds[1]});
    const Vec2 hitch = rotated({-actual_.hitch_offset_m, 0.0}, middle.heading_rad);
    set_in_motion(world_, body_, {tow.at(world_.pose(body_).position() - middle.position()), tow.yaw_rate_radps});
    set_in_motion(world_, towed_, towed_motion(world_.pose(towed_), actual_.drawbar_length_m, tow.at(hitch)));
  }
  void step(const Ground& ground, const Floor& floor) {
    tracks_.before_step(ground, floor);
    axle_->before_step();
    pull_downhill(world_, body_, tow_mass_kg_, floor);
    pull_downhill(world_, towed_, masses_.mass_kg, floor);
    world_.step();
    tracks_.after_step();
    axle_->after_step(ground);
  }
  void push(Vec2 impulse_ns) override { world_.apply_force(body_, (1.0 / step_s_) * impulse_ns); }
  void set_clock(double begin_s) override { axle_->set_clock(begin_s); }

  Pose pose() const override { return world_.pose(body_) * tracks_middle_; }
  double speed_mps() const override { return world_.velocity_of_point_mps(body_, {}).x_m; }
  double yaw_rate_radps() const override { return world_.yaw_rate_radps(body_); }
  WheelState left() const override { return tracks_.left(); }
  WheelState right() const override { return tracks_.right(); }
  void place_other_bodies(std::vector<Pose>& poses) const override { poses = {world_.pose(towed_)}; }

  VehicleShape shape() const override {
    VehicleShape shape;
    const int tow = add_tracked_shape(shape, actual_.tow, contact_length_m_, tracks_middle_.x_m);
    shape.rods.push_back({tow, tow, tracks_middle_.position(), tracks_middle_ * Vec2{-actual_.hitch_offset_m, 0.0}});
    add_trailer_shape(shape, actual_.trailer, actual_.drawbar_length_m, "trailer ");
    shape.gauges = {{"hitch angle", "hitch_angle_rad", false}};
    return shape;
  }
  void pose_parts(VehiclePosture& posture) const override {
    posture.bodies = {world_.pose(body_), world_.pose(towed_)};
    posture.wheels = {left(), right(), axle_->left(), axle_->right()};
    posture.gauges = {{wrapped(world_.pose(body_).heading_rad - world_.pose(towed_).heading_rad), 0.0}};
  }

  std::vector<std::string> channels() const override {
    return {"left_wheel_rad", "right_wheel_rad", "trailer_left_wheel_rad", "trailer_right_wheel_rad",
            "hitch_angle_rad"};
  }
  void sample(double time_s, std::vector<double>& readings) override {
    const WheelPair noise = slip_ring_.false_counts(time_s);
    const double rad_per_count = 2.0 * kPi / nominal_.trailer.counts_per_wheel_turn();
    const WheelPair read = axle_->read(time_s);
    const WheelPair now{read.left + noise.left * rad_per_count, read.right + noise.right * rad_per_count};
    const double hitch_rad = hitch_reading_rad();
    // Section 4.5: dead reckoning of the trailer, then "a simple coordinate transformation" by the hitch's angle.
    if (read_)
      believed_trailer_ =
          dead_reckoned(believed_trailer_, now.left - read_->left, now.right - read_->right, nominal_.trailer);
    hitch_unwrapped_rad_ += wrapped(hitch_rad - hitch_unwrapped_rad_);  // the trailer may swivel by any angle
    if (!read_) believed_trailer_ = believed_ * inverse(trailer_T_tow(nominal_, hitch_unwrapped_rad_));
    read_ = now;
    believed_ = believed_trailer_ * trailer_T_tow(nominal_, hitch_unwrapped_rad_);
    readings = {left_encoder_.reading_rad(left().counted_rad), right_encoder_.reading_rad(right().counted_rad),
                now.left, now.right, hitch_rad};
  }
  Pose believed() const override { return believed_; }

 private:
  // What the absolute encoder reads: within a turn, in whole steps.
  double hitch_reading_rad() {
    const double angle_rad = world_.pose(body_).heading_rad - world_.pose(towed_).heading_rad;
    const double noise_rad = masses_.hitch_noise_rad > 0.0 ? masses_.hitch_noise_rad * hitch_noise_.normal() : 0.0;
    return wrapped(
        quantised(angle_rad + actual_.hitch_angle_offset_rad + noise_rad, nominal_.hitch_angle_resolution_rad));
  }

  EncoderTrailer nominal_, actual_;
  ActualTrailer masses_;
  double tow_mass_kg_;
  double contact_length_m_;
  Pose tracks_middle_;  // in the frame of the towing vehicle's centre of mass
  double step_s_;
  PlanarWorld world_;
  int body_, towed_;
  PairOfTracks tracks_;
  planar::Effects effects_;  // of the trailer
  std::optional<FreeAxle> axle_;
  SlipRing slip_ring_;
  Random hitch_noise_;
  Encoder left_encoder_{1.0, 0.0}, right_encoder_{1.0, 0.0};
  std::optional<WheelPair> read_;  // last, of the trailer
  double hitch_unwrapped_rad_ = 0.0;
  Pose believed_trailer_, believed_;
};

}  // namespace

std::unique_ptr<PlanarVehicle> make_encoder_trailer(const VehicleSetup& setup) {
  const auto* nominal = std::get_if<EncoderTrailer>(&setup.scenario.vehicle.kind);
  if (!nominal) return nullptr;
  return std::make_unique<PlanarEncoderTrailer>(
      setup, *nominal, true_lengths<EncoderTrailer>(setup.scenario.machine, setup.scenario.vehicle));
}

}  // namespace odolab
