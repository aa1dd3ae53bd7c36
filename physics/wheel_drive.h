// A drive wheel with its motor and speed controller.
#pragma once

#include "core/scenario/scenario.h"
#include "physics/wheel_pair.h"

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
  // The same for two wheels that move one body: `shared_inertia_kgm2` is how much of it the one feels when the other
  // is accelerated. Without it a body that is heavier to turn than to push makes its wheels chatter.
  static WheelPair advance_together(WheelDrive& left, WheelDrive& right, double shared_inertia_kgm2,
                                    WheelPair set_speed_radps, WheelPair traction_n, double step_s);
  // The same of a motor whose wheel nothing holds at the moment: it moves itself alone.
  double advance_free(double set_speed_radps, double step_s);
  // The same for a floor that is solved together with the wheel (README, Eq. 6b): the speed that it would have in this
  // step without the floor, and the inertia by which it yields to it, controller included.
  struct Unloaded {
    double speed_radps = 0.0;
    double inertia_kgm2 = 0.0;  // 0: it turns as told, whatever the floor does
  };
  Unloaded unloaded() const { return unloaded_; }
  // The speed that came of it takes the place of the one that `advance` said.
  void settle_at(double speed_radps);
  // The wheel is turned from outside to a speed; the motor takes it as its own.
  void turn_at(double speed_radps, double step_s);

  double speed_radps() const { return speed_radps_; }
  double rotation_rad() const { return rotation_rad_; }

 private:
  double torque_nm(double set_speed_radps, double traction_n, double step_s);
  double accelerated(double acceleration_radps2, double step_s);
  void unload(double traction_n);

  Motor motor_;
  double radius_m_;
  double carried_inertia_kgm2_;
  double speed_radps_ = 0.0;
  double acceleration_radps2_ = 0.0;
  double rotation_rad_ = 0.0;
  double lag_rad_ = 0.0;  // integral of the speed error
  Unloaded unloaded_;
  // Before the last step, and what was wanted in it:
  double speed_before_radps_ = 0.0, rotation_before_rad_ = 0.0, lag_before_rad_ = 0.0, set_radps_ = 0.0, step_s_ = 0.0;
};

}  // namespace odolab
