// A differential drive on the floor: one body, two driven wheels, castors that roll freely.
#pragma once

#include <array>
#include <cstdint>

#include "core/scenario/scenario.h"
#include "physics/effects/effects.h"
#include "physics/ground.h"
#include "physics/planar_world.h"
#include "physics/wheel_drive.h"

namespace odolab {

// What one wheel does in a step.
struct WheelState {
  double rotation_rad = 0.0;  // true, since the start
  double counted_rad = 0.0;   // by an encoder of endless resolution: the same, but for effects between the two
  double speed_radps = 0.0;
  double slip_speed_mps = 0.0;  // tread against floor, along the wheel
  double traction_n = 0.0;      // force of the floor on the wheel, along it
  bool on_bump = false;
  bool in_slip_zone = false;
};

class PlanarDifferentialDrive {
 public:
  // The effects must outlive it; they are already built into `actual`.
  PlanarDifferentialDrive(const ActualDrive& actual, const Motor& motor, const Pose& start, double step_s,
                          const planar::Effects& effects);

  // One step on this ground with the motors set to these speeds, in rad/s.
  void drive(const Ground& ground, const Floor& floor, WheelPair set_speed_radps);
  // One step in which the encoders are to count exactly these speeds.
  void turn_wheels(const Ground& ground, const Floor& floor, WheelPair speed_radps);
  // The wheels turn at these speeds from now on, and the vehicle moves with them.
  void begin_in_motion(WheelPair speed_radps);
  // The clock of the run at its start, for effects that have a time; 0 if not told.
  void set_clock(double begin_s) { begin_s_ = begin_s; }
  // A push from outside at the centre of mass, spread over the next step.
  void push(Vec2 impulse_ns);

  const Pose& pose() const { return world_.pose(body_); }
  double speed_mps() const;
  double yaw_rate_radps() const { return world_.yaw_rate_radps(body_); }
  const WheelState& left() const { return wheels_[0].state; }
  const WheelState& right() const { return wheels_[1].state; }

 private:
  struct Wheel {
    WheelDrive drive;
    Side side;
    Vec2 place;  // in the body's frame
    double radius_m;
    double toe_rad;
    Vec2 rolling_direction;  // in the body's frame
    int tread = 0;
    double travelled_m = 0.0;
    double mean_speed_radps = 0.0;  // of the wheel, over the step
    double rolling_radius_m = radius_m;
    double tread_mps = 0.0;  // along the wheel
    double slip_in_effect_mps = 0.0;
    double grip_n = 0.0;
    WheelState state{};
  };

  void turn(Wheel& wheel, double motor_speed_radps);
  void roll(const Ground& ground, const Floor& floor);
  planar::VehicleMotion motion(double heading_rad) const;
  void roll_with_effects(double heading_rad);
  void creep_with_effects(double heading_rad);

  PlanarWorld world_;
  double step_s_;
  double mass_kg_;
  double wheel_load_n_;
  double moment_of_inertia_kgm2_;
  double wheelbase_m_;
  int body_;
  std::array<Wheel, 2> wheels_;
  const planar::Effects* effects_;
  double begin_s_ = 0.0;
  std::int64_t steps_ = 0;
};

}  // namespace odolab
