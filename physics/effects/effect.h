// What an effect can touch in the planar world, at the place where it really acts. README.md says what each effect
// does.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/diagnosis/active_effect.h"
#include "core/geometry/pose.h"
#include "core/scenario/scenario.h"
#include "physics/ground.h"
#include "physics/wheel_pair.h"

namespace odolab::planar {

// The vehicle in the middle of the coming step, as far as it is known before it.
struct VehicleMotion {
  double time_s = 0.0;  // of the run; in a replay on the recording's clock
  double since_start_s = 0.0;
  double heading_rad = 0.0;
  Vec2 position;                // of the axle's centre on the floor
  double speed_mps = 0.0;       // of the axle's centre along the vehicle, in the step before
  double yaw_rate_radps = 0.0;  // in the step before
  // What the wheels of this step would give the vehicle if they rolled truly: while they are rolled, with the radii
  // that no effect has changed.
  double rolled_speed_mps = 0.0;
  double rolled_yaw_rate_radps = 0.0;
};

// One wheel in the coming step.
struct RollingWheel {
  Side side = Side::left;
  Vec2 contact;               // on the floor
  double rotation_rad = 0.0;  // at the middle of the step
  double speed_radps = 0.0;
  double radius_m = 0.075;  // rolling; effects change it
  bool yields = false;      // to the floor, by what its motor gives way
  double slip_mps = 0.0;    // effects add to it: the floor under the wheel moves by so much less than the wheel rolls
};

// A motion of the whole vehicle that the wheels do not roll: it is added to what every tread does. Of the axle's
// centre, in the vehicle's frame.
struct Creep {
  Vec2 velocity_mps;
  double yaw_rate_radps = 0.0;
  // Forces from outside that come with it, per mass and per moment of inertia, so that the wheels need not give them.
  Vec2 push_mps2;
  double push_radps2 = 0.0;
};

// An effect changes what it acts on and leaves the rest alone. Hooks are called once a step in the order of their
// listing.
class Effect {
 public:
  virtual ~Effect() = default;

  // Before the run:
  virtual void lay_on(Floor&) const {}
  virtual void build_into(ActualDrive&) const {}
  virtual void build_into_lengths(VehicleKind&) const {}  // true lengths and sensor offsets of the other kinds
  virtual void mount(TruthMounting&) const {}             // where the truth really sits, and how late its stamps are

  // Each step, from the driver to the floor:
  virtual void command(WheelPair& /*set_speed_radps*/) {}
  // From the motor, where the encoder sits, to the wheel: a turn in this step.
  virtual void gear(Side, double& /*turn_rad*/) {}
  // Whether the motor holds its wheel, so that it feels what the floor asks of it.
  virtual bool holds(Side) const { return true; }
  // What an encoder counts of a turn of its shaft at a speed; and for a replay, the speed behind the speed that it
  // counted.
  virtual void count(Side, double /*speed_radps*/, double& /*turn_rad*/) {}
  virtual void uncount(Side, double& /*speed_radps*/) const {}
  virtual void roll(const VehicleMotion&, RollingWheel&) {}
  virtual void creep(const VehicleMotion&, Creep&) {}

  // Each sample:
  virtual void read_encoder(Side, double /*time_s*/, double& /*reading_rad*/) {}
  virtual void measure_truth(double /*time_s*/, Pose&) {}
  virtual void stamp_robot(double /*since_start_s*/, double& /*stamp_s*/) const {}
};

// What an effect has to know of the machine that it is built into.
struct Machine {
  ActualDrive actual;
  double step_s = 0.001;
};

// The form in which an effect is switched on (core/diagnosis/effects/forms.h); none: as README.md says.
inline std::optional<int> form_of(const ActiveEffect& active) {
  const double form = active.parameter("form", -1.0);
  return form < 0.0 ? std::nullopt : std::optional(static_cast<int>(form));
}

// True where an effect on a component ("left_wheel", "both_wheels", "vehicle", ...) is one on this wheel.
inline bool acts_on(const std::string& component, Side side) {
  return component == "left_wheel" ? side == Side::left : component == "right_wheel" ? side == Side::right : true;
}

}  // namespace odolab::planar
