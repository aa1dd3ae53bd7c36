#include "physics/vehicles/planar_linked_trucks.h"

#include "core/scenario/effect_catalogue.h"
#include "physics/sensors/absolute_encoder.h"
#include "physics/vehicles/axle_commands.h"

namespace odolab {

namespace {

// How the link stands as a recording begins: the direction from B to A, and truck B.
struct LinkAtStart {
  double heading_rad;
  Pose truck_b;
};

LinkAtStart link_at_start(const VehicleSetup& setup, const LinkedTrucks& lengths) {
  double angle_a_rad = 0.0, angle_b_rad = 0.0, length_m = lengths.link_length_m;
  if (const std::vector<double>& r = setup.first_readings; !r.empty()) {
    angle_a_rad = r[4] - lengths.link_angle_a_offset_rad;
    angle_b_rad = r[5] - lengths.link_angle_b_offset_rad;
    length_m = r[6] - lengths.link_length_offset_m;
  }
  const double heading_rad = setup.start.heading_rad - angle_a_rad;
  const Vec2 b = setup.start.position() - rotated({length_m, 0.0}, heading_rad);
  return {heading_rad, {b.x_m, b.y_m, heading_rad + angle_b_rad}};
}

}  // namespace

PlanarLinkedTrucks::PlanarLinkedTrucks(const VehicleSetup& setup, const LinkedTrucks& nominal,
                                       const LinkedTrucks& lengths, bool with_platform)
    : nominal_(nominal),
      lengths_(lengths),
      link_(setup.scenario.machine.link),
      step_s_(setup.scenario.step_s),
      effects_a_(effects_of_part(setup.scenario.effects, "truck_a"),
                 {with_wheels_of(lengths.truck_a, setup.scenario.actual), step_s_}),
      effects_b_(effects_of_part(setup.scenario.effects, "truck_b"),
                 {with_wheels_of(lengths.truck_b, setup.scenario.actual), step_s_}),
      world_(step_s_),
      phases_(setup.sensor_seed),
      a_(world_, setup.start, nominal.truck_a, with_wheels_of(lengths.truck_a, setup.scenario.actual), setup,
         effects_a_, 0, phases_),
      b_(world_, link_at_start(setup, lengths).truck_b, nominal.truck_b,
         with_wheels_of(lengths.truck_b, setup.scenario.actual), setup, effects_b_, 1, phases_),
      control_(nominal.link_length_m, setup.scenario.sensors.encoder_period_s),
      belief_({nominal.truck_a, nominal.truck_b, nominal.link_angle_resolution_rad, nominal.link_angle_resolution_rad},
              setup.start, setup.scenario.driving.internal_correction) {
  const double length_m = lengths.link_length_m;
  if (with_platform) {
    // A bar of the link's length and half as wide.
    const double inertia_kgm2 = link_.platform_mass_kg * length_m * length_m * (1.0 + 0.25) / 12.0;
    const Pose at_a{setup.start.x_m, setup.start.y_m, link_at_start(setup, lengths).heading_rad};
    platform_ = world_.add_body({at_a * Pose{-0.5 * length_m, 0.0, 0.0}, link_.platform_mass_kg, inertia_kgm2});
    world_.add_pin({a_.body(), *platform_, {}, {0.5 * length_m, 0.0}});
    world_.add_slider(
        {*platform_, b_.body(), {-0.5 * length_m, 0.0}, {}, 0.0, link_.spring_frequency_hz, link_.damping_ratio});
  } else {
    world_.add_spring({a_.body(), b_.body(), {}, {}, length_m, link_.spring_frequency_hz, link_.damping_ratio});
  }
}

void PlanarLinkedTrucks::drive(const Ground& ground, const Floor& floor, const CommandRamp& command) {
  if (sampled_) {
    sampled_ = false;
    const TruckCommands commands = control_.update(command.next, readings_);
    set_a_before_ = set_a_next_;
    set_b_before_ = set_b_next_;
    set_a_next_ = wheel_speeds(commands.a, a_.nominal());
    set_b_next_ = wheel_speeds(commands.b, b_.nominal());
  }
  a_.axle().turn_motors(between(set_a_before_, set_a_next_, command.share));
  b_.axle().turn_motors(between(set_b_before_, set_b_next_, command.share));
  step(ground, floor);
}

std::vector<std::string> PlanarLinkedTrucks::turned_channels() const {
  return {"a_left_wheel_rad", "a_right_wheel_rad", "b_left_wheel_rad", "b_right_wheel_rad"};
}

void PlanarLinkedTrucks::turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds) {
  a_.axle().turn_exactly({speeds[0], speeds[1]});
  b_.axle().turn_exactly({speeds[2], speeds[3]});
  step(ground, floor);
}

void PlanarLinkedTrucks::begin_in_motion(const std::vector<double>& speeds) {
  const BodyVelocity a = rolling_motion(a_.pose(), lengths_.truck_a, {speeds[0], speeds[1]});
  const BodyVelocity b = rolling_motion(b_.pose(), lengths_.truck_b, {speeds[2], speeds[3]});
  set_in_motion(world_, a_.body(), a);
  set_in_motion(world_, b_.body(), b);
  if (!platform_) return;
  const Vec2 link = a_.pose().position() - b_.pose().position();
  const double turn_radps = cross(link, a.velocity_mps - b.velocity_mps) / dot(link, link);
  const Vec2 arm = world_.pose(*platform_).position() - a_.pose().position();
  set_in_motion(world_, *platform_, {BodyVelocity{a.velocity_mps, turn_radps}.at(arm), turn_radps});
}

void PlanarLinkedTrucks::step(const Ground& ground, const Floor& floor) {
  for (Truck* truck : {&a_, &b_}) {
    truck->axle().before_step(ground, floor);
    pull_downhill(world_, truck->body(), truck->mass_kg(), floor);
  }
  if (platform_) pull_downhill(world_, *platform_, link_.platform_mass_kg, floor);
  world_.step();
  a_.axle().after_step();
  b_.axle().after_step();
}

void PlanarLinkedTrucks::push(Vec2 impulse_ns) { world_.apply_force(a_.body(), (1.0 / step_s_) * impulse_ns); }

void PlanarLinkedTrucks::place_other_bodies(std::vector<Pose>& poses) const {
  poses.resize(platform_ ? 2 : 1);
  poses[0] = b_.pose();
  if (platform_) poses[1] = world_.pose(*platform_);
}

std::vector<std::string> PlanarLinkedTrucks::channels() const {
  return {"a_left_wheel_rad", "a_right_wheel_rad", "b_left_wheel_rad", "b_right_wheel_rad",
          "link_angle_a_rad", "link_angle_b_rad",  "link_length_m"};
}

VehicleShape PlanarLinkedTrucks::shape() const {
  VehicleShape shape;
  const int a = add_drive_shape(shape, lengths_.truck_a, "A ");
  const int b = add_drive_shape(shape, lengths_.truck_b, "B ");
  if (platform_) {
    const double half_m = 0.5 * lengths_.link_length_m, side_m = 0.25 * lengths_.link_length_m;
    const double end_m = half_m + 0.2 * lengths_.link_length_m;
    shape.free_castors.clear();  // they stand under the platform
    for (const double x : {-half_m, half_m})
      for (const double y : {-0.8 * side_m, 0.8 * side_m}) shape.free_castors.push_back({2, {x, y}, 0.02});
    shape.bodies.push_back({{{-end_m, -side_m}, {end_m, -side_m}, {end_m, side_m}, {-end_m, side_m}}, true});
  }
  shape.rods.push_back({b, a, {}, {}, true});
  shape.joints = {{a, {}}, {b, {}}};
  shape.gauges = {{"link angle A", "link_angle_a_rad", false},
                  {"link angle B", "link_angle_b_rad", false},
                  {"link length", "link_length_m", true}};
  return shape;
}

void PlanarLinkedTrucks::pose_parts(VehiclePosture& posture) const {
  posture.bodies = {a_.pose(), b_.pose()};
  if (platform_) posture.bodies.push_back(world_.pose(*platform_));
  posture.wheels = {a_.axle().left(), a_.axle().right(), b_.axle().left(), b_.axle().right()};
  const LinkReadings link = true_link();
  posture.gauges = {{wrapped(link.angle_a_rad), 0.0}, {wrapped(link.angle_b_rad), 0.0}, {link.length_m, 0.0}};
}

LinkReadings PlanarLinkedTrucks::true_link() const {
  const Vec2 link = a_.pose().position() - b_.pose().position();
  const double heading_rad = std::atan2(link.y_m, link.x_m);
  LinkReadings out;
  out.angle_a_rad = a_.pose().heading_rad - heading_rad;
  out.angle_b_rad = b_.pose().heading_rad - heading_rad;
  out.length_m = length(link);
  return out;
}

LinkReadings PlanarLinkedTrucks::read_link() const {
  const LinkReadings link = true_link();
  const double swing_m = link_.length_eccentricity_m * std::cos(link.angle_a_rad + link_.length_eccentricity_phase_rad);
  LinkReadings out;
  out.angle_a_rad =
      wrapped(quantised(link.angle_a_rad + lengths_.link_angle_a_offset_rad, nominal_.link_angle_resolution_rad));
  out.angle_b_rad =
      wrapped(quantised(link.angle_b_rad + lengths_.link_angle_b_offset_rad, nominal_.link_angle_resolution_rad));
  out.length_m = quantised(link.length_m + lengths_.link_length_offset_m + swing_m, nominal_.link_length_resolution_m);
  return out;
}

void PlanarLinkedTrucks::sample(double time_s, std::vector<double>& readings) {
  const WheelPair a = a_.read(time_s), b = b_.read(time_s);
  const LinkReadings link = read_link();
  readings = {a.left, a.right, b.left, b.right, link.angle_a_rad, link.angle_b_rad, link.length_m};
  // The offsets that the vehicle file knows are taken off what the controller sees.
  readings_ = {link.angle_a_rad - nominal_.link_angle_a_offset_rad, link.angle_b_rad - nominal_.link_angle_b_offset_rad,
               link.length_m - nominal_.link_length_offset_m};
  belief_.advance(
      {time_s, {a.left, a.right}, {b.left, b.right}, readings_.angle_a_rad, readings_.angle_b_rad, readings_.length_m});
  sampled_ = true;
}

namespace {

template <typename Kind>
std::unique_ptr<PlanarVehicle> make(const VehicleSetup& setup, bool with_platform) {
  const auto* nominal = std::get_if<Kind>(&setup.scenario.vehicle.kind);
  if (!nominal) return nullptr;
  const Kind& lengths = true_lengths<Kind>(setup.scenario.machine, setup.scenario.vehicle);
  return std::make_unique<PlanarLinkedTrucks>(setup, *nominal, lengths, with_platform);
}

}  // namespace

std::unique_ptr<PlanarVehicle> make_clapper(const VehicleSetup& setup) { return make<Clapper>(setup, false); }
std::unique_ptr<PlanarVehicle> make_omnimate(const VehicleSetup& setup) { return make<OmniMate>(setup, true); }

}  // namespace odolab
