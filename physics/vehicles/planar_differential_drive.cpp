#include "physics/vehicles/planar_differential_drive.h"

namespace odolab {

namespace {
constexpr double kGravity_mps2 = 9.81;
}

PlanarDifferentialDrive::PlanarDifferentialDrive(const ActualDrive& a, const Motor& motor, const Pose& start, double step_s)
    : world_(step_s),
      step_s_(step_s),
      mass_kg_(a.mass_kg),
      half_base_m_(0.5 * a.wheelbase_m),
      wheel_load_n_(0.5 * a.drive_wheel_load_share * a.mass_kg * kGravity_mps2),
      body_(world_.add_body({start, a.mass_kg, a.moment_of_inertia_kgm2})),
      wheels_{Wheel{WheelDrive(motor, a.wheel_radius_left_m, 0.5 * a.mass_kg * a.wheel_radius_left_m * a.wheel_radius_left_m),
                    Side::left,
                    {0.0, 0.5 * a.wheelbase_m},
                    a.wheel_radius_left_m,
                    a.toe_left_rad,
                    {std::cos(a.toe_left_rad), std::sin(a.toe_left_rad)}},
              Wheel{WheelDrive(motor, a.wheel_radius_right_m, 0.5 * a.mass_kg * a.wheel_radius_right_m * a.wheel_radius_right_m),
                    Side::right,
                    {0.0, -0.5 * a.wheelbase_m},
                    a.wheel_radius_right_m,
                    a.toe_right_rad,
                    {std::cos(a.toe_right_rad), std::sin(a.toe_right_rad)}}} {
  for (Wheel& wheel : wheels_) wheel.tread = world_.add_tread(body_, wheel.place);
}

void PlanarDifferentialDrive::drive(const Ground& ground, const Floor& floor, WheelPair set) {
  wheels_[0].mean_speed_radps = wheels_[0].drive.advance(set.left, wheels_[0].state.traction_n, step_s_);
  wheels_[1].mean_speed_radps = wheels_[1].drive.advance(set.right, wheels_[1].state.traction_n, step_s_);
  roll(ground, floor);
}

void PlanarDifferentialDrive::turn_wheels(const Ground& ground, const Floor& floor, WheelPair speed) {
  wheels_[0].drive.turn_at(speed.left, step_s_);
  wheels_[1].drive.turn_at(speed.right, step_s_);
  wheels_[0].mean_speed_radps = speed.left;
  wheels_[1].mean_speed_radps = speed.right;
  roll(ground, floor);
}

void PlanarDifferentialDrive::begin_in_motion(WheelPair speed) {
  const double left_mps = wheels_[0].radius_m * speed.left, right_mps = wheels_[1].radius_m * speed.right;
  const Vec2 velocity = rotated({0.5 * (left_mps + right_mps), 0.0}, world_.pose(body_).heading_rad);
  world_.set_velocity(body_, velocity, (right_mps - left_mps) / (2.0 * half_base_m_));
}

void PlanarDifferentialDrive::push(Vec2 impulse_ns) { world_.apply_force(body_, (1.0 / step_s_) * impulse_ns); }

double PlanarDifferentialDrive::speed_mps() const {
  const double heading = world_.pose(body_).heading_rad;
  return dot(world_.velocity_mps(body_), {std::cos(heading), std::sin(heading)});
}

void PlanarDifferentialDrive::roll(const Ground& ground, const Floor& floor) {
  // Where the wheels will stand at the middle of the step.
  const Pose& pose = world_.pose(body_);
  const double heading_rad = pose.heading_rad + 0.5 * step_s_ * world_.yaw_rate_radps(body_);
  const Vec2 centre = pose.position() + (0.5 * step_s_) * world_.velocity_mps(body_);
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  for (Wheel& wheel : wheels_) {
    const Vec2 contact_place{centre.x_m + c * wheel.place.x_m - s * wheel.place.y_m,
                             centre.y_m + s * wheel.place.x_m + c * wheel.place.y_m};
    const Contact contact =
        ground.under({wheel.side, contact_place, heading_rad + wheel.toe_rad, wheel.radius_m, wheel.travelled_m});
    const double tread_mps = wheel.radius_m * wheel.mean_speed_radps * contact.horizontal_share * (1.0 - contact.slip);
    wheel.travelled_m += tread_mps * step_s_;
    world_.set_tread(wheel.tread, tread_mps * wheel.rolling_direction, contact.friction * wheel_load_n_ * std::cos(floor.tilt_rad));
    wheel.state.on_bump = contact.on_bump;
    wheel.state.in_slip_zone = contact.in_slip_zone;
    wheel.state.slip_speed_mps = tread_mps;  // less the floor's, below
  }
  if (floor.tilt_rad != 0.0) {
    const double pull_n = mass_kg_ * kGravity_mps2 * std::sin(floor.tilt_rad);
    world_.apply_force(body_, {pull_n * std::cos(floor.downhill_direction_rad), pull_n * std::sin(floor.downhill_direction_rad)});
  }
  world_.step();

  const Vec2 v = world_.velocity_mps(body_);
  const Vec2 velocity{c * v.x_m + s * v.y_m, -s * v.x_m + c * v.y_m};  // of the centre, in the body's frame at mid-step
  const double rate = world_.yaw_rate_radps(body_);
  for (Wheel& wheel : wheels_) {
    const Vec2 above{velocity.x_m - rate * wheel.place.y_m, velocity.y_m + rate * wheel.place.x_m};
    wheel.state.slip_speed_mps -= dot(above, wheel.rolling_direction);
    wheel.state.traction_n = dot(world_.tread_force_n(wheel.tread), wheel.rolling_direction);
    wheel.state.speed_radps = wheel.drive.speed_radps();
    wheel.state.rotation_rad = wheel.drive.rotation_rad();
  }
}

}  // namespace odolab
