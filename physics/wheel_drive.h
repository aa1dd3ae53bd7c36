// A drive wheel with its motor and speed controller.
#pragma once

#include "core/scenario/scenario.h"

namespace odolab {

// Turns a wheel after a set speed. An ideal motor follows exactly; a real one has inertia, limited torque and a
// proportional-integral controller, and feels the traction of the floor.
class WheelDrive {
 public:
  // `carried_inertia_kgm2`: how much of the vehicle a gripping wheel moves, seen at the wheel. It only decides how soon
  // the traction is followed, not what the speed settles to (README, Eq. 6).
  WheelDrive(const Motor& motor, double radius_m, double carried_inertia_kgm2);

  // Advances by one step towards the set speed. Returns the mean speed over the step, which the tread then has.
  double advance(double set_speed_radps, double traction_n, double step_s);
  // The wheel is turned from outside to a speed; the motor takes it as its own.
  void turn_at(double speed_radps, double step_s);

  double speed_radps() const { return speed_radps_; }
  double rotation_rad() const { return rotation_rad_; }

 private:
  Motor motor_;
  double radius_m_;
  double carried_inertia_kgm2_;
  double speed_radps_ = 0.0;
  double acceleration_radps2_ = 0.0;
  double rotation_rad_ = 0.0;
  double lag_rad_ = 0.0;  // integral of the speed error
};

}  // namespace odolab
