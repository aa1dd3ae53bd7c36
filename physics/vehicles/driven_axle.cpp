#include "physics/vehicles/driven_axle.h"

#include <algorithm>

namespace odolab {

namespace {

// How much of the body a wheel moves when it is accelerated alone, as a mass at its rim.
double carried_mass_kg(const ActualDrive& a) {
  return 0.25 * a.mass_kg + a.moment_of_inertia_kgm2 / (a.wheelbase_m * a.wheelbase_m);
}

}  // namespace

DrivenAxle::DrivenAxle(PlanarWorld& world, int body, Vec2 centre, const ActualDrive& a, const Motor& motor,
                       double step_s, const planar::Effects& effects, int number)
    : world_(&world),
      body_(body),
      step_s_(step_s),
      mass_kg_(a.mass_kg),
      wheel_load_n_(0.5 * a.drive_wheel_load_share * a.mass_kg * kGravity_mps2),
      moment_of_inertia_kgm2_(a.moment_of_inertia_kgm2),
      wheelbase_m_(a.wheelbase_m),
      shared_inertia_kgm2_((0.5 * a.mass_kg - carried_mass_kg(a)) * a.wheel_radius_left_m * a.wheel_radius_right_m),
      number_(number),
      wheels_{Wheel{WheelDrive(motor, a.wheel_radius_left_m,
                               carried_mass_kg(a) * a.wheel_radius_left_m * a.wheel_radius_left_m),
                    Side::left,
                    centre + Vec2{0.0, 0.5 * a.wheelbase_m},
                    a.wheel_radius_left_m,
                    a.toe_left_rad,
                    {std::cos(a.toe_left_rad), std::sin(a.toe_left_rad)}},
              Wheel{WheelDrive(motor, a.wheel_radius_right_m,
                               carried_mass_kg(a) * a.wheel_radius_right_m * a.wheel_radius_right_m),
                    Side::right,
                    centre + Vec2{0.0, -0.5 * a.wheelbase_m},
                    a.wheel_radius_right_m,
                    a.toe_right_rad,
                    {std::cos(a.toe_right_rad), std::sin(a.toe_right_rad)}}},
      effects_(&effects) {
  for (Wheel& wheel : wheels_) {
    wheel.tread = world_->add_tread(body_, wheel.place);
    wheel.motor = world_->add_drive(body_);
  }
}

void DrivenAxle::turn_motors(WheelPair set) {
  if (is_held(wheels_[0]) && is_held(wheels_[1])) {
    const WheelPair turned =
        WheelDrive::advance_together(wheels_[0].drive, wheels_[1].drive, shared_inertia_kgm2_, set,
                                     {wheels_[0].state.traction_n, wheels_[1].state.traction_n}, step_s_);
    turn(wheels_[0], turned.left);
    turn(wheels_[1], turned.right);
    return;
  }
  for (Wheel& wheel : wheels_) {
    const double set_radps = wheel.side == Side::left ? set.left : set.right;
    turn(wheel, is_held(wheel) ? wheel.drive.advance(set_radps, wheel.state.traction_n, step_s_)
                               : wheel.drive.advance_free(set_radps, step_s_));
  }
}

bool DrivenAxle::is_held(const Wheel& wheel) const {
  return std::all_of(effects_->begin(), effects_->end(), [&](const auto& effect) { return effect->holds(wheel.side); });
}

void DrivenAxle::turn_exactly(WheelPair speed) {
  for (const auto& effect : *effects_) {
    effect->uncount(Side::left, speed.left);
    effect->uncount(Side::right, speed.right);
  }
  wheels_[0].drive.turn_at(speed.left, step_s_);
  wheels_[1].drive.turn_at(speed.right, step_s_);
  turn(wheels_[0], speed.left);
  turn(wheels_[1], speed.right);
}

// From the motor to the encoder and to the wheel.
void DrivenAxle::turn(Wheel& wheel, double motor_speed_radps) {
  wheel.mean_speed_radps = wheel.motor_speed_radps = motor_speed_radps;
  if (effects_->empty()) {
    wheel.state.rotation_rad = wheel.state.counted_rad = wheel.drive.rotation_rad();
    return;
  }
  double counted_rad = motor_speed_radps * step_s_, turned_rad = counted_rad;
  for (const auto& effect : *effects_) {
    effect->count(wheel.side, motor_speed_radps, counted_rad);
    effect->gear(wheel.side, turned_rad);
  }
  wheel.mean_speed_radps = turned_rad / step_s_;
  wheel.state.rotation_rad += turned_rad;
  wheel.state.counted_rad += counted_rad;
}

void DrivenAxle::before_step(const Ground& ground, const Floor& floor) {
  // Where the wheels will stand at the middle of the step.
  const Pose& pose = world_->pose(body_);
  const double heading_rad = pose.heading_rad + 0.5 * step_s_ * world_->yaw_rate_radps(body_);
  const Vec2 centre = pose.position() + (0.5 * step_s_) * world_->velocity_mps(body_);
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  cos_middle_ = c;
  sin_middle_ = s;
  const bool plain = effects_->empty();
  if (!plain) roll_with_effects(heading_rad);
  for (Wheel& wheel : wheels_) {
    const Vec2 contact_place{centre.x_m + c * wheel.place.x_m - s * wheel.place.y_m,
                             centre.y_m + s * wheel.place.x_m + c * wheel.place.y_m};
    const Contact contact = ground.under(
        {wheel.side, contact_place, heading_rad + wheel.toe_rad, wheel.radius_m, wheel.travelled_m, number_});
    const double tread_mps =
        wheel.rolling_radius_m * wheel.mean_speed_radps * contact.horizontal_share * (1.0 - contact.slip);
    wheel.metres_per_rad = wheel.rolling_radius_m * contact.horizontal_share * (1.0 - contact.slip);
    wheel.travelled_m += tread_mps * step_s_;
    wheel.tread_mps = tread_mps;
    wheel.grip_n = contact.friction * wheel_load_n_ * std::cos(floor.tilt_rad);
    if (plain) {
      world_->set_tread(wheel.tread, tread_mps * wheel.rolling_direction, wheel.grip_n);
      let_yield(wheel);
    }
    wheel.state.on_bump = contact.on_bump;
    wheel.state.in_slip_zone = contact.in_slip_zone;
    wheel.state.slip_speed_mps = tread_mps;  // less the floor's, after the step
  }
  if (!plain) creep_with_effects(heading_rad);
}

void DrivenAxle::let_yield(const Wheel& wheel) {
  const WheelDrive::Unloaded unloaded = wheel.drive.unloaded();
  const double gear = wheel.metres_per_rad;
  if (unloaded.inertia_kgm2 == 0.0 || gear <= 0.0 || !is_held(wheel)) return;
  world_->set_drive(wheel.motor, unloaded.inertia_kgm2 / (gear * gear),
                    gear * (unloaded.speed_radps - wheel.motor_speed_radps));
  world_->set_tread_drive(wheel.tread, wheel.motor, wheel.rolling_direction);
}

// The wheel turned a little more or less than its motor had meant.
void DrivenAxle::take_yield(Wheel& wheel) {
  const double change_mps = world_->drive_change_mps(wheel.motor);
  const double change_radps = change_mps / wheel.metres_per_rad;
  wheel.drive.settle_at(wheel.motor_speed_radps + change_radps);
  wheel.mean_speed_radps += change_radps;
  wheel.tread_mps += change_mps;
  wheel.travelled_m += change_mps * step_s_;
  wheel.state.slip_speed_mps += change_mps;
  if (effects_->empty()) {
    wheel.state.rotation_rad = wheel.state.counted_rad = wheel.drive.rotation_rad();
  } else {
    wheel.state.rotation_rad += change_radps * step_s_;
    wheel.state.counted_rad += change_radps * step_s_;
  }
}

void DrivenAxle::after_step() {
  const double c = cos_middle_, s = sin_middle_;
  const Vec2 v = world_->velocity_mps(body_);
  const Vec2 velocity{c * v.x_m + s * v.y_m, -s * v.x_m + c * v.y_m};  // of the centre, in the body's frame at mid-step
  const double rate = world_->yaw_rate_radps(body_);
  for (Wheel& wheel : wheels_) {
    if (world_->solved_exactly() && wheel.drive.unloaded().inertia_kgm2 > 0.0 && wheel.metres_per_rad > 0.0 &&
        is_held(wheel))
      take_yield(wheel);
    const Vec2 above{velocity.x_m - rate * wheel.place.y_m, velocity.y_m + rate * wheel.place.x_m};
    wheel.state.slip_speed_mps -= dot(above, wheel.rolling_direction);
    wheel.state.traction_n = dot(world_->tread_force_n(wheel.tread), wheel.rolling_direction);
    wheel.state.speed_radps = wheel.drive.speed_radps();
  }
  ++steps_;
}

planar::VehicleMotion DrivenAxle::motion(double heading_rad) const {
  planar::VehicleMotion motion;
  motion.position = world_->pose(body_).position() + (0.5 * step_s_) * world_->velocity_mps(body_) +
                    rotated(0.5 * (wheels_[0].place + wheels_[1].place), heading_rad);
  motion.since_start_s = (static_cast<double>(steps_) + 0.5) * step_s_;
  motion.time_s = begin_s_ + motion.since_start_s;
  motion.heading_rad = heading_rad;
  const double heading = world_->pose(body_).heading_rad;
  motion.speed_mps = dot(world_->velocity_mps(body_), {std::cos(heading), std::sin(heading)});
  motion.yaw_rate_radps = world_->yaw_rate_radps(body_);
  return motion;
}

// The rolling radius of each wheel in this step, and what it slips along its way.
void DrivenAxle::roll_with_effects(double heading_rad) {
  planar::VehicleMotion now = motion(heading_rad);
  const Vec2 body = world_->pose(body_).position() + (0.5 * step_s_) * world_->velocity_mps(body_);
  const double left_mps = wheels_[0].radius_m * wheels_[0].mean_speed_radps,
               right_mps = wheels_[1].radius_m * wheels_[1].mean_speed_radps;
  now.rolled_speed_mps = 0.5 * (left_mps + right_mps);
  now.rolled_yaw_rate_radps = (right_mps - left_mps) / wheelbase_m_;
  for (Wheel& wheel : wheels_) {
    planar::RollingWheel rolling;
    rolling.contact = body + rotated(wheel.place, heading_rad);
    rolling.side = wheel.side;
    rolling.speed_radps = wheel.mean_speed_radps;
    rolling.rotation_rad = wheel.state.rotation_rad - 0.5 * step_s_ * wheel.mean_speed_radps;
    rolling.radius_m = wheel.radius_m;
    rolling.yields = wheel.drive.unloaded().inertia_kgm2 > 0.0;
    for (const auto& effect : *effects_) effect->roll(now, rolling);
    wheel.rolling_radius_m = rolling.radius_m;
    wheel.slip_in_effect_mps = rolling.slip_mps;
  }
}

// Sets the treads: each rolls, less its slip, and all creep together.
void DrivenAxle::creep_with_effects(double heading_rad) {
  planar::VehicleMotion now = motion(heading_rad);
  const double left_mps = wheels_[0].tread_mps, right_mps = wheels_[1].tread_mps;
  now.rolled_speed_mps = 0.5 * (left_mps + right_mps);
  now.rolled_yaw_rate_radps = (right_mps - left_mps) / wheelbase_m_;
  planar::Creep creep;
  for (const auto& effect : *effects_) effect->creep(now, creep);
  for (const Wheel& wheel : wheels_) {
    const Vec2 turning{-creep.yaw_rate_radps * wheel.place.y_m, creep.yaw_rate_radps * wheel.place.x_m};
    const Vec2 rolling = (wheel.tread_mps - wheel.slip_in_effect_mps) * wheel.rolling_direction;
    world_->set_tread(wheel.tread, rolling + creep.velocity_mps + turning, wheel.grip_n);
    let_yield(wheel);
  }
  world_->apply_force(body_, mass_kg_ * rotated(creep.push_mps2, heading_rad),
                      moment_of_inertia_kgm2_ * creep.push_radps2);
}

}  // namespace odolab
