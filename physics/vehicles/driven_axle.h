// Two driven wheels on one axle line of a body in the planar world.
#pragma once

#include <array>
#include <cstdint>

#include "core/scenario/scenario.h"
#include "physics/effects/effects.h"
#include "physics/ground.h"
#include "physics/planar_world.h"
#include "physics/vehicles/wheel_state.h"
#include "physics/wheel_drive.h"

namespace odolab {

constexpr double kGravity_mps2 = 9.81;

class DrivenAxle {
 public:
  // `actual` says the wheels, what they carry (mass) and with which load they press. The world and the effects must
  // outlive it; the effects are already built into `actual`. Each axle of a vehicle has a number of its own, by which
  // it meets roughness of its own.
  DrivenAxle(PlanarWorld& world, int body, Vec2 centre, const ActualDrive& actual, const Motor& motor, double step_s,
             const planar::Effects& effects, int number = 0);

  // First, one of these: the motors are set to these speeds in this step; or the encoders are to count exactly these.
  void turn_motors(WheelPair set_speed_radps);
  void turn_exactly(WheelPair speed_radps);
  // Then the treads are set for the world's step, and what came of it is looked at.
  void before_step(const Ground& ground, const Floor& floor);
  void after_step();

  void set_clock(double begin_s) { begin_s_ = begin_s; }
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
    int motor = 0;  // in the world
    double travelled_m = 0.0;
    double motor_speed_radps = 0.0;  // over the step, as the motor means it before the floor has its say
    double mean_speed_radps = 0.0;   // of the wheel, over the step
    double metres_per_rad = 0.0;
    double rolling_radius_m = radius_m;
    double tread_mps = 0.0;  // along the wheel
    double slip_in_effect_mps = 0.0;
    double grip_n = 0.0;
    WheelState state{};
  };

  bool is_held(const Wheel& wheel) const;  // by its motor
  void turn(Wheel& wheel, double motor_speed_radps);
  void let_yield(const Wheel& wheel);
  void take_yield(Wheel& wheel);
  planar::VehicleMotion motion(double heading_rad) const;
  void roll_with_effects(double heading_rad);
  void creep_with_effects(double heading_rad);

  PlanarWorld* world_;
  int body_;
  double step_s_;
  double mass_kg_;
  double wheel_load_n_;
  double moment_of_inertia_kgm2_;
  double wheelbase_m_;
  double shared_inertia_kgm2_;
  int number_;
  std::array<Wheel, 2> wheels_;
  const planar::Effects* effects_;
  double begin_s_ = 0.0;
  double cos_middle_ = 1.0, sin_middle_ = 0.0;  // heading in the middle of the step
  std::int64_t steps_ = 0;
};

}  // namespace odolab
