// A platform on active split offset castors: each castor a body of its own on two driven wheels, pinned beside its
// axle.
#include <algorithm>
#include <memory>

#include "core/base/random.h"
#include "core/odometry/cast.h"
#include "core/scenario/effect_catalogue.h"
#include "physics/sensors/absolute_encoder.h"
#include "physics/sensors/encoder.h"
#include "physics/vehicles/axle_commands.h"
#include "physics/vehicles/driven_axle.h"
#include "physics/vehicles/planar_vehicle.h"

namespace odolab {

namespace {

// The wheels of a castor as an axle under an even share of the whole weight.
ActualDrive axle_of(const Castor& castor, double carried_kg, const ActualCastors& weight) {
  ActualDrive axle;
  axle.wheel_radius_left_m = castor.wheel_radius_left_m;
  axle.wheel_radius_right_m = castor.wheel_radius_right_m;
  axle.wheelbase_m = castor.track_m();
  axle.mass_kg = carried_kg;
  axle.moment_of_inertia_kgm2 = weight.moment_of_inertia_kgm2;
  axle.drive_wheel_load_share = 1.0;
  return axle;
}

// An encoder without steps counts finely enough for doubles.
double counts_per_turn(double resolution_rad) { return resolution_rad > 0.0 ? 2.0 * kPi / resolution_rad : 1e12; }

class PlanarMultiCastor final : public PlanarVehicle {
 public:
  PlanarMultiCastor(const VehicleSetup& setup, const MultiCastor& nominal, const MultiCastor& lengths)
      : nominal_(nominal),
        lengths_(lengths),
        weight_(setup.scenario.machine.castors),
        platform_kg_(setup.scenario.actual.mass_kg),
        step_s_(setup.scenario.step_s),
        world_(step_s_, Friction::in_every_step),
        platform_(world_.add_body({setup.start, platform_kg_, setup.scenario.actual.moment_of_inertia_kgm2})),
        believed_(setup.start) {
    Random phases(setup.sensor_seed);
    const double n = static_cast<double>(lengths.castors.size());
    effects_.reserve(lengths.castors.size());  // axles keep pointers to them
    for (std::size_t i = 0; i < lengths.castors.size(); ++i) {
      const Castor& castor = lengths.castors[i];
      const double angle_rad =
          setup.first_readings.empty() ? 0.0 : setup.first_readings[3 * i + 2] - castor.pivot_encoder_offset_rad;
      const Pose pivot = setup.start * Pose{castor.pivot().x_m, castor.pivot().y_m, angle_rad};
      const int body =
          world_.add_body({pivot * Pose{-castor.offset_m, 0.0, 0.0}, weight_.mass_kg, weight_.moment_of_inertia_kgm2});
      world_.add_pin({platform_, body, castor.pivot(), {castor.offset_m, 0.0}});
      const Vec2 axle_centre{0.0, 0.5 * (castor.wheel_offset_left_m - castor.wheel_offset_right_m)};
      const ActualDrive drawn = axle_of(castor, platform_kg_ / n + weight_.mass_kg, weight_);
      effects_.emplace_back(effects_of_part(setup.scenario.effects, "castor" + std::to_string(i + 1)),
                            planar::Machine{drawn, step_s_});
      const ActualDrive axle = effects_.back().built_into(drawn);
      const double counts = counts_per_turn(nominal.wheel_encoder_resolution_rad);
      const double left_phase = phases.uniform(), right_phase = phases.uniform();
      castors_.push_back(
          {body,
           DrivenAxle(world_, body, axle_centre, axle, setup.scenario.motor, step_s_, effects_[i], static_cast<int>(i)),
           Encoder(counts, left_phase), Encoder(counts, right_phase)});
    }
  }

  void drive(const Ground& ground, const Floor& floor, const CommandRamp& command) override {
    const double u = command.share;
    const BaseCommand& a = command.before;
    const BaseCommand& b = command.next;
    const Vec2 velocity{a.speed_mps + u * (b.speed_mps - a.speed_mps),
                        a.sideways_mps + u * (b.sideways_mps - a.sideways_mps)};
    const double rate = a.yaw_rate_radps + u * (b.yaw_rate_radps - a.yaw_rate_radps);
    for (std::size_t i = 0; i < castors_.size(); ++i) castors_[i].axle.turn_motors(wheel_speeds_of(i, velocity, rate));
    step(ground, floor);
  }
  std::vector<std::string> turned_channels() const override {
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= castors_.size(); ++i)
      for (const char* wheel : {"_left_wheel_rad", "_right_wheel_rad"})
        names.push_back("castor" + std::to_string(i) + wheel);
    return names;
  }
  void turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds) override {
    for (std::size_t i = 0; i < castors_.size(); ++i) castors_[i].axle.turn_exactly({speeds[2 * i], speeds[2 * i + 1]});
    step(ground, floor);
  }
  void begin_in_motion(const std::vector<double>& speeds) override {
    Vec2 mean;
    std::vector<Vec2> pivots;  // their velocities
    const double n = static_cast<double>(castors_.size());
    for (std::size_t i = 0; i < castors_.size(); ++i) {
      const Castor& c = lengths_.castors[i];
      const double left_mps = c.wheel_radius_left_m * speeds[2 * i],
                   right_mps = c.wheel_radius_right_m * speeds[2 * i + 1];
      const double turn_radps = (right_mps - left_mps) / c.track_m();
      const double travel_mps = (left_mps * c.wheel_offset_right_m + right_mps * c.wheel_offset_left_m) / c.track_m();
      const double heading_rad = world_.pose(castors_[i].body).heading_rad;
      const BodyVelocity castor{rotated({travel_mps, 0.0}, heading_rad), turn_radps};
      set_in_motion(world_, castors_[i].body, castor);
      pivots.push_back(castor.at(rotated({c.offset_m, 0.0}, heading_rad)));
    }
    // The platform moves as its pivots do on average, and turns as they turn about their middle.
    Vec2 middle;
    std::vector<Vec2> places;
    for (const Castor& c : lengths_.castors) places.push_back(rotated(c.pivot(), pose().heading_rad));
    for (std::size_t i = 0; i < places.size(); ++i) {
      middle = middle + (1.0 / n) * places[i];
      mean = mean + (1.0 / n) * pivots[i];
    }
    double turned = 0.0, square = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      turned += cross(places[i] - middle, pivots[i] - mean);
      square += dot(places[i] - middle, places[i] - middle);
    }
    const double turn_radps = square > 0.0 ? turned / square : 0.0;
    set_in_motion(world_, platform_, {BodyVelocity{mean, turn_radps}.at(Vec2{} - middle), turn_radps});
  }
  void step(const Ground& ground, const Floor& floor) {
    for (std::size_t i = 0; i < castors_.size(); ++i) {
      castors_[i].axle.before_step(ground, floor);
      pull_downhill(world_, castors_[i].body, weight_.mass_kg, floor);
    }
    pull_downhill(world_, platform_, platform_kg_, floor);
    world_.step();
    for (DrivenCastor& castor : castors_) castor.axle.after_step();
  }
  void push(Vec2 impulse_ns) override { world_.apply_force(platform_, (1.0 / step_s_) * impulse_ns); }
  void set_clock(double begin_s) override {
    for (DrivenCastor& castor : castors_) castor.axle.set_clock(begin_s);
  }

  Pose pose() const override { return world_.pose(platform_); }
  double speed_mps() const override { return world_.velocity_of_point_mps(platform_, {}).x_m; }
  double yaw_rate_radps() const override { return world_.yaw_rate_radps(platform_); }
  WheelState left() const override { return castors_.front().axle.left(); }  // of the first castor
  WheelState right() const override { return castors_.front().axle.right(); }
  void place_other_bodies(std::vector<Pose>& poses) const override {
    poses.resize(castors_.size());
    for (std::size_t i = 0; i < castors_.size(); ++i) poses[i] = world_.pose(castors_[i].body);
  }

  VehicleShape shape() const override {
    VehicleShape shape;
    double reach_m = 0.0;
    for (const Castor& castor : lengths_.castors) reach_m = std::max(reach_m, castor.pivot_radius_m);
    shape.bodies.push_back({round_outline(reach_m + 0.03), true});
    for (std::size_t i = 0; i < lengths_.castors.size(); ++i) {
      const Castor& c = lengths_.castors[i];
      const int body = int(i) + 1;
      const std::string name = "castor " + std::to_string(body) + " ";
      const double width_m = std::min(0.5 * c.wheel_radius_left_m, 0.25 * c.track_m());
      shape.bodies.push_back({});
      shape.rods.push_back({body, body, {0.0, c.wheel_offset_left_m}, {0.0, -c.wheel_offset_right_m}, false});
      shape.rods.push_back({body, body, {0.0, 0.0}, {c.offset_m, 0.0}, false});
      shape.wheels.push_back({name + "left", body, {0.0, c.wheel_offset_left_m}, 0.0, c.wheel_radius_left_m, width_m});
      shape.wheels.push_back(
          {name + "right", body, {0.0, -c.wheel_offset_right_m}, 0.0, c.wheel_radius_right_m, width_m});
      shape.joints.push_back({body, {c.offset_m, 0.0}});
      shape.gauges.push_back({"pivot " + std::to_string(body), "castor" + std::to_string(body) + "_pivot_rad", false});
    }
    return shape;
  }
  void pose_parts(VehiclePosture& posture) const override {
    posture.bodies = {world_.pose(platform_)};
    posture.wheels.clear();
    posture.gauges.clear();
    for (std::size_t i = 0; i < castors_.size(); ++i) {
      posture.bodies.push_back(world_.pose(castors_[i].body));
      posture.wheels.push_back(castors_[i].axle.left());
      posture.wheels.push_back(castors_[i].axle.right());
      posture.gauges.push_back({wrapped(pivot_rad_of(i)), 0.0});
    }
  }

  std::vector<std::string> channels() const override {
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= castors_.size(); ++i)
      for (const char* reading : {"_left_wheel_rad", "_right_wheel_rad", "_pivot_rad"})
        names.push_back("castor" + std::to_string(i) + reading);
    return names;
  }
  void sample(double time_s, std::vector<double>& readings) override {
    readings.clear();
    CastorSample now{time_s, {}};
    for (std::size_t i = 0; i < castors_.size(); ++i) {
      const DrivenCastor& castor = castors_[i];
      double left_rad = castor.left_encoder.reading_rad(castor.axle.left().counted_rad);
      double right_rad = castor.right_encoder.reading_rad(castor.axle.right().counted_rad);
      for (const auto& effect : effects_[i]) {
        effect->read_encoder(Side::left, time_s, left_rad);
        effect->read_encoder(Side::right, time_s, right_rad);
      }
      const double pivot_rad = wrapped(quantised(pivot_rad_of(i) + lengths_.castors[i].pivot_encoder_offset_rad,
                                                 nominal_.pivot_encoder_resolution_rad));
      readings.insert(readings.end(), {left_rad, right_rad, pivot_rad});
      const double unwrapped_rad = last_.castors.empty() ? pivot_rad : unwrapped(pivot_rad, last_.castors[i].pivot_rad);
      now.castors.push_back({{left_rad, right_rad}, unwrapped_rad});
    }
    if (!last_.castors.empty())
      believed_ = moved_by_pivots(
          believed_, pivot_ways(nominal_, last_, now, believed_, HeadingRule::middle, no_one_left_out()), {});
    last_ = now;
  }
  Pose believed() const override { return believed_; }

 private:
  struct DrivenCastor {
    int body;
    DrivenAxle axle;
    Encoder left_encoder, right_encoder;
  };

  double pivot_rad_of(std::size_t i) const {
    return world_.pose(castors_[i].body).heading_rad - world_.pose(platform_).heading_rad;
  }
  std::vector<char> no_one_left_out() const { return std::vector<char>(castors_.size(), 0); }

  // The pivot moves with the body; along the castor that is the axle's travel, across it the castor's turn about its
  // axle. By the nominal geometry, and by the pivot's encoder, which the motors' electronics read without pause.
  WheelPair wheel_speeds_of(std::size_t i, Vec2 velocity, double rate) const {
    const Castor& castor = nominal_.castors[i];
    // In the middle of the step, where the treads will act.
    const double swing_radps = world_.yaw_rate_radps(castors_[i].body) - world_.yaw_rate_radps(platform_);
    const double pivot_rad = pivot_rad_of(i) + 0.5 * step_s_ * swing_radps +
                             lengths_.castors[i].pivot_encoder_offset_rad - castor.pivot_encoder_offset_rad;
    const Vec2 p = castor.pivot();
    const Vec2 over_floor{velocity.x_m - rate * p.y_m, velocity.y_m + rate * p.x_m};
    const Vec2 in_castor = rotated(over_floor, -pivot_rad);
    const double turn_radps = in_castor.y_m / castor.offset_m;
    return {(in_castor.x_m - castor.wheel_offset_left_m * turn_radps) / castor.wheel_radius_left_m,
            (in_castor.x_m + castor.wheel_offset_right_m * turn_radps) / castor.wheel_radius_right_m};
  }

  MultiCastor nominal_, lengths_;
  ActualCastors weight_;
  double platform_kg_;
  double step_s_;
  std::vector<planar::Effects> effects_;  // of each castor
  PlanarWorld world_;
  int platform_;
  std::vector<DrivenCastor> castors_;
  CastorSample last_;
  Pose believed_;
};

}  // namespace

std::unique_ptr<PlanarVehicle> make_multi_castor(const VehicleSetup& setup) {
  const auto* nominal = std::get_if<MultiCastor>(&setup.scenario.vehicle.kind);
  if (!nominal) return nullptr;
  return std::make_unique<PlanarMultiCastor>(setup, *nominal,
                                             true_lengths<MultiCastor>(setup.scenario.machine, setup.scenario.vehicle));
}

}  // namespace odolab
