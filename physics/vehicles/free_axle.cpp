#include "physics/vehicles/free_axle.h"

#include "core/base/random.h"

namespace odolab {

FreeAxle::FreeAxle(PlanarWorld& world, int body, const DifferentialDrive& actual, double counts_per_turn, int number,
                   Random& phases)
    : world_(&world),
      body_(body),
      number_(number),
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

void FreeAxle::after_step(const Ground& ground, double step_s) {
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
    const double turned_rad = rolled_m / (wheel.radius_m * contact.horizontal_share);
    wheel.state.rotation_rad += turned_rad;
    wheel.state.speed_radps = turned_rad / step_s;
    wheel.state.on_bump = contact.on_bump;
    wheel.state.in_slip_zone = contact.in_slip_zone;
  }
}

WheelPair FreeAxle::read() const {
  return {wheels_[0].encoder.reading_rad(wheels_[0].state.rotation_rad),
          wheels_[1].encoder.reading_rad(wheels_[1].state.rotation_rad)};
}

}  // namespace odolab
