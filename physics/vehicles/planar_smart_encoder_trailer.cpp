// A differential drive that tows the Smart Encoder Trailer: a passive truck B, rigid up to its hitch, which sits at the
// towing vehicle's centre (UMBmark report, section 4.6).
#include "core/scenario/effect_catalogue.h"
#include "physics/sensors/absolute_encoder.h"
#include "physics/vehicles/axle_commands.h"
#include "physics/vehicles/free_axle.h"
#include "physics/vehicles/linked_belief.h"
#include "physics/vehicles/planar_vehicle.h"
#include "physics/vehicles/truck.h"

namespace odolab {

namespace {

double smart_hitch_at_start_rad(const VehicleSetup& setup, const SmartEncoderTrailer& lengths) {
  return setup.first_readings.empty() ? 0.0 : setup.first_readings[4] - lengths.hitch_angle_offset_rad;
}

class PlanarSmartEncoderTrailer final : public PlanarVehicle {
 public:
  PlanarSmartEncoderTrailer(const VehicleSetup& setup, const SmartEncoderTrailer& nominal,
                            const SmartEncoderTrailer& lengths)
      : nominal_(nominal),
        lengths_(lengths),
        trailer_(setup.scenario.machine.trailer),
        step_s_(setup.scenario.step_s),
        effects_(effects_of_part(setup.scenario.effects, "trailer"), {setup.scenario.actual, step_s_}),
        world_(step_s_),
        phases_(setup.sensor_seed),
        tow_(world_, setup.start, nominal.tow, with_wheels_of(lengths.tow, setup.scenario.actual), setup, setup.effects,
             0, phases_),
        towed_(world_.add_body({setup.start * Pose{0.0, 0.0, -smart_hitch_at_start_rad(setup, lengths)} *
                                    Pose{-lengths.drawbar_length_m, 0.0, 0.0},
                                trailer_.mass_kg, trailer_.moment_of_inertia_kgm2})),
        axle_(world_, towed_, lengths.trailer, nominal.trailer.counts_per_wheel_turn(), 1, effects_, step_s_, phases_),
        noise_(seed_of_stream(setup.sensor_seed, 1)),
        belief_({nominal.tow, nominal.trailer, nominal.hitch_angle_resolution_rad, 0.0}, setup.start,
                setup.scenario.driving.internal_correction) {
    world_.add_pin({tow_.body(), towed_, {}, {lengths.drawbar_length_m, 0.0}});
  }

  void drive(const Ground& ground, const Floor& floor, const CommandRamp& command) override {
    tow_.axle().turn_motors(
        between(wheel_speeds(command.before, nominal_.tow), wheel_speeds(command.next, nominal_.tow), command.share));
    step(ground, floor);
  }
  std::vector<std::string> turned_channels() const override { return {"left_wheel_rad", "right_wheel_rad"}; }
  void turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds) override {
    tow_.axle().turn_exactly({speeds[0], speeds[1]});
    step(ground, floor);
  }
  void begin_in_motion(const std::vector<double>& speeds) override {
    const BodyVelocity tow = rolling_motion(tow_.pose(), lengths_.tow, {speeds[0], speeds[1]});
    set_in_motion(world_, tow_.body(), tow);
    set_in_motion(world_, towed_, towed_motion(world_.pose(towed_), lengths_.drawbar_length_m, tow.velocity_mps));
  }
  void step(const Ground& ground, const Floor& floor) {
    tow_.axle().before_step(ground, floor);
    axle_.before_step();
    pull_downhill(world_, tow_.body(), tow_.mass_kg(), floor);
    pull_downhill(world_, towed_, trailer_.mass_kg, floor);
    world_.step();
    tow_.axle().after_step();
    axle_.after_step(ground);
  }
  void push(Vec2 impulse_ns) override { world_.apply_force(tow_.body(), (1.0 / step_s_) * impulse_ns); }
  void set_clock(double begin_s) override { tow_.axle().set_clock(begin_s), axle_.set_clock(begin_s); }

  Pose pose() const override { return tow_.pose(); }
  double speed_mps() const override { return world_.velocity_of_point_mps(tow_.body(), {}).x_m; }
  double yaw_rate_radps() const override { return world_.yaw_rate_radps(tow_.body()); }
  WheelState left() const override { return tow_.axle().left(); }
  WheelState right() const override { return tow_.axle().right(); }
  void place_other_bodies(std::vector<Pose>& poses) const override {
    poses.resize(1);
    poses[0] = world_.pose(towed_);
  }

  VehicleShape shape() const override {
    VehicleShape shape;
    add_drive_shape(shape, lengths_.tow, "");
    add_trailer_shape(shape, lengths_.trailer, lengths_.drawbar_length_m, "trailer ");
    shape.gauges = {{"hitch angle", "hitch_angle_rad", false}};
    return shape;
  }
  void pose_parts(VehiclePosture& posture) const override {
    posture.bodies = {tow_.pose(), world_.pose(towed_)};
    posture.wheels = {left(), right(), axle_.left(), axle_.right()};
    posture.gauges = {{wrapped(tow_.pose().heading_rad - world_.pose(towed_).heading_rad), 0.0}};
  }

  std::vector<std::string> channels() const override {
    return {"left_wheel_rad", "right_wheel_rad", "trailer_left_wheel_rad", "trailer_right_wheel_rad",
            "hitch_angle_rad"};
  }
  void sample(double time_s, std::vector<double>& readings) override {
    const WheelPair tow = tow_.read(time_s), trailer = axle_.read(time_s);
    const double hitch_rad = tow_.pose().heading_rad - world_.pose(towed_).heading_rad;
    const double noise_rad = trailer_.hitch_noise_rad > 0.0 ? trailer_.hitch_noise_rad * noise_.normal() : 0.0;
    const double reading_rad = wrapped(
        quantised(hitch_rad + lengths_.hitch_angle_offset_rad + noise_rad, nominal_.hitch_angle_resolution_rad));
    readings = {tow.left, tow.right, trailer.left, trailer.right, reading_rad};
    belief_.advance({time_s,
                     {tow.left, tow.right},
                     {trailer.left, trailer.right},
                     reading_rad - nominal_.hitch_angle_offset_rad,
                     0.0,
                     nominal_.drawbar_length_m});
  }
  Pose believed() const override { return belief_.truck_a(); }

 private:
  SmartEncoderTrailer nominal_, lengths_;
  ActualTrailer trailer_;
  double step_s_;
  planar::Effects effects_;  // of the trailer
  PlanarWorld world_;
  Random phases_;
  Truck tow_;
  int towed_;
  FreeAxle axle_;
  Random noise_;
  LinkedBelief belief_;
};

}  // namespace

std::unique_ptr<PlanarVehicle> make_smart_encoder_trailer(const VehicleSetup& setup) {
  const auto* nominal = std::get_if<SmartEncoderTrailer>(&setup.scenario.vehicle.kind);
  if (!nominal) return nullptr;
  return std::make_unique<PlanarSmartEncoderTrailer>(
      setup, *nominal, true_lengths<SmartEncoderTrailer>(setup.scenario.machine, setup.scenario.vehicle));
}

}  // namespace odolab
