#include "physics/vehicles/free_axle.h"

#include "core/base/random.h"

namespace odolab {

FreeAxle::FreeAxle(PlanarWorld& world, int body, const DifferentialDrive& actual, double counts_per_turn, int number,
                   const planar::Effects& effects, double step_s, Random& phases)
    : world_(&world),
      body_(body),
      number_(number),
      effects_(&effects),
      step_s_(step_s),
      wheels_{Wheel{Side::left,
                    {0.0, 0.5 * actual.wheelbase_m},
                    actual.wheel_radius_left_m,
                    Encoder(counts_per_turn, phases.uniform())},
              Wheel{Side::right,
                    {0.0, -0.5 * actual.wheelbase_m},
                    actual.wheel_radius_right_m,
                    Encoder(counts_per_turn, phases.uniform())}} {
  world_->add_free_wheel(body, {});  // both: on one axle they hold the same sideways motion
}

void FreeAxle::before_step() { before_ = world_->pose(body_); }

void FreeAxle::after_step(const Ground& ground) {
  const Pose& after = world_->pose(body_);
  const double turn_rad = after.heading_rad - before_.heading_rad;
  const double heading_rad = before_.heading_rad + 0.5 * turn_rad;
  const Vec2 moved = after.position() - before_.position(), middle = before_.position() + 0.5 * moved;
  const double travel_m = dot(moved, {std::cos(heading_rad), std::sin(heading_rad)});
  for (Wheel& wheel : wheels_) {
    const double rolled_m = travel_m - turn_rad * wheel.place.y_m;
    const Contact contact = ground.under({wheel.side, middle + rotated(wheel.place, heading_rad), heading_rad,
                                          wheel.radius_m, wheel.travelled_m, number_});
    wheel.travelled_m += rolled_m;
    planar::RollingWheel rolling;
    rolling.side = wheel.side;
    rolling.contact = middle + rotated(wheel.place, heading_rad);
    rolling.rotation_rad = wheel.state.rotation_rad;
    rolling.speed_radps = rolled_m / (wheel.radius_m * step_s_);
    rolling.radius_m = wheel.radius_m;
    planar::VehicleMotion motion;
    motion.heading_rad = heading_rad;
    motion.position = middle;
    motion.since_start_s = (static_cast<double>(steps_) + 0.5) * step_s_;
    motion.time_s = begin_s_ + motion.since_start_s;
    for (const auto& effect : *effects_) effect->roll(motion, rolling);
    const double turned_rad = rolled_m / (rolling.radius_m * contact.horizontal_share);
    double counted_rad = turned_rad;
    for (const auto& effect : *effects_) effect->count(wheel.side, turned_rad / step_s_, counted_rad);
    wheel.state.rotation_rad += turned_rad;
    wheel.state.counted_rad += counted_rad;
    wheel.state.speed_radps = turned_rad / step_s_;
    wheel.state.on_bump = contact.on_bump;
    wheel.state.in_slip_zone = contact.in_slip_zone;
  }
  ++steps_;
}

WheelPair FreeAxle::read(double time_s) const {
  WheelPair now{wheels_[0].encoder.reading_rad(wheels_[0].state.counted_rad),
                wheels_[1].encoder.reading_rad(wheels_[1].state.counted_rad)};
  for (const auto& effect : *effects_) {
    effect->read_encoder(Side::left, time_s, now.left);
    effect->read_encoder(Side::right, time_s, now.right);
  }
  return now;
}

}  // namespace odolab
