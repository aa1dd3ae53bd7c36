#include "physics/wheel_drive.h"

#include <algorithm>
#include <cmath>

namespace odolab {

WheelDrive::WheelDrive(const Motor& motor, double radius_m, double carried_inertia_kgm2)
    : motor_(motor), radius_m_(radius_m), carried_inertia_kgm2_(carried_inertia_kgm2) {}

double WheelDrive::torque_nm(double set_speed_radps, double traction_n, double step_s) {
  speed_before_radps_ = speed_radps_;
  rotation_before_rad_ = rotation_rad_;
  lag_before_rad_ = lag_rad_;
  set_radps_ = set_speed_radps;
  step_s_ = step_s;
  unload(traction_n);
  const double error_radps = set_speed_radps - speed_radps_;
  const double wanted_nm =
      motor_.proportional_gain * error_radps + motor_.integral_gain * (lag_rad_ + error_radps * step_s);
  const double torque_nm = std::clamp(wanted_nm, -motor_.torque_limit_nm, motor_.torque_limit_nm);
  if (torque_nm == wanted_nm) lag_rad_ += error_radps * step_s;  // a saturated motor does not wind up
  return torque_nm;
}

double WheelDrive::accelerated(double acceleration_radps2, double step_s) {
  acceleration_radps2_ = acceleration_radps2;
  const double mean_radps = speed_radps_ + 0.5 * acceleration_radps2_ * step_s;
  speed_radps_ += acceleration_radps2_ * step_s;
  rotation_rad_ += mean_radps * step_s;
  return mean_radps;
}

// The traction is that of the step before. Taken as it stands it would make a light wheel on a heavy vehicle unstable;
// the part of it that accelerates the vehicle is therefore predicted and only the rest is taken from the step before.
double WheelDrive::advance(double set_speed_radps, double traction_n, double step_s) {
  if (motor_.ideal) {
    turn_at(set_speed_radps, step_s);
    return set_speed_radps;
  }
  const double load_nm = radius_m_ * traction_n - carried_inertia_kgm2_ * acceleration_radps2_;
  return accelerated(
      (torque_nm(set_speed_radps, traction_n, step_s) - load_nm) / (motor_.wheel_inertia_kgm2 + carried_inertia_kgm2_),
      step_s);
}

double WheelDrive::advance_free(double set_speed_radps, double step_s) {
  if (motor_.ideal) return advance(set_speed_radps, 0.0, step_s);
  return accelerated(torque_nm(set_speed_radps, 0.0, step_s) / motor_.wheel_inertia_kgm2, step_s);
}

WheelPair WheelDrive::advance_together(WheelDrive& left, WheelDrive& right, double shared_inertia_kgm2, WheelPair set,
                                       WheelPair traction_n, double step_s) {
  if (left.motor_.ideal) return {left.advance(set.left, 0.0, step_s), right.advance(set.right, 0.0, step_s)};
  const double ll = left.carried_inertia_kgm2_, rr = right.carried_inertia_kgm2_, lr = shared_inertia_kgm2;
  const double was_left = left.acceleration_radps2_, was_right = right.acceleration_radps2_;
  const double on_left = left.torque_nm(set.left, traction_n.left, step_s) - left.radius_m_ * traction_n.left +
                         ll * was_left + lr * was_right;
  const double on_right = right.torque_nm(set.right, traction_n.right, step_s) - right.radius_m_ * traction_n.right +
                          lr * was_left + rr * was_right;
  const double a = left.motor_.wheel_inertia_kgm2 + ll, d = right.motor_.wheel_inertia_kgm2 + rr;
  const double det = a * d - lr * lr;
  return {left.accelerated((d * on_left - lr * on_right) / det, step_s),
          right.accelerated((a * on_right - lr * on_left) / det, step_s)};
}

// The controller acts on the speed that comes out, unless its torque is at its limit.
void WheelDrive::unload(double traction_n) {
  const double h = step_s_, j = motor_.wheel_inertia_kgm2;
  const double stiff = motor_.proportional_gain + motor_.integral_gain * h;
  const double torque_at_rest_nm = stiff * set_radps_ + motor_.integral_gain * lag_before_rad_;
  unloaded_.inertia_kgm2 = j + h * stiff;
  unloaded_.speed_radps = (j * speed_before_radps_ + h * torque_at_rest_nm) / unloaded_.inertia_kgm2;
  const double expected_radps = unloaded_.speed_radps - h * radius_m_ * traction_n / unloaded_.inertia_kgm2;
  const double wanted_nm = torque_at_rest_nm - stiff * expected_radps;
  if (std::abs(wanted_nm) <= motor_.torque_limit_nm) return;
  unloaded_.inertia_kgm2 = j;
  unloaded_.speed_radps = speed_before_radps_ + std::copysign(motor_.torque_limit_nm, wanted_nm) * h / j;
}

void WheelDrive::settle_at(double speed_radps) {
  acceleration_radps2_ = (speed_radps - speed_before_radps_) / step_s_;
  speed_radps_ = speed_radps;
  rotation_rad_ = rotation_before_rad_ + speed_radps * step_s_;
  const double error_radps = set_radps_ - speed_radps;
  const double wanted_nm =
      motor_.proportional_gain * error_radps + motor_.integral_gain * (lag_before_rad_ + error_radps * step_s_);
  lag_rad_ = std::abs(wanted_nm) <= motor_.torque_limit_nm ? lag_before_rad_ + error_radps * step_s_ : lag_before_rad_;
}

void WheelDrive::turn_at(double speed_radps, double step_s) {
  acceleration_radps2_ = 0.0;
  unloaded_ = {};
  speed_radps_ = speed_radps;
  rotation_rad_ += speed_radps * step_s;
}

}  // namespace odolab
