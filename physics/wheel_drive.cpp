#include "physics/wheel_drive.h"

#include <algorithm>

namespace odolab {

WheelDrive::WheelDrive(const Motor& motor, double radius_m, double carried_inertia_kgm2)
    : motor_(motor), radius_m_(radius_m), carried_inertia_kgm2_(carried_inertia_kgm2) {}

double WheelDrive::torque_nm(double set_speed_radps, double step_s) {
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
      (torque_nm(set_speed_radps, step_s) - load_nm) / (motor_.wheel_inertia_kgm2 + carried_inertia_kgm2_), step_s);
}

WheelPair WheelDrive::advance_together(WheelDrive& left, WheelDrive& right, double shared_inertia_kgm2, WheelPair set,
                                       WheelPair traction_n, double step_s) {
  if (left.motor_.ideal) return {left.advance(set.left, 0.0, step_s), right.advance(set.right, 0.0, step_s)};
  const double ll = left.carried_inertia_kgm2_, rr = right.carried_inertia_kgm2_, lr = shared_inertia_kgm2;
  const double was_left = left.acceleration_radps2_, was_right = right.acceleration_radps2_;
  const double on_left =
      left.torque_nm(set.left, step_s) - left.radius_m_ * traction_n.left + ll * was_left + lr * was_right;
  const double on_right =
      right.torque_nm(set.right, step_s) - right.radius_m_ * traction_n.right + lr * was_left + rr * was_right;
  const double a = left.motor_.wheel_inertia_kgm2 + ll, d = right.motor_.wheel_inertia_kgm2 + rr;
  const double det = a * d - lr * lr;
  return {left.accelerated((d * on_left - lr * on_right) / det, step_s),
          right.accelerated((a * on_right - lr * on_left) / det, step_s)};
}

void WheelDrive::turn_at(double speed_radps, double step_s) {
  acceleration_radps2_ = 0.0;
  speed_radps_ = speed_radps;
  rotation_rad_ += speed_radps * step_s;
}

}  // namespace odolab
