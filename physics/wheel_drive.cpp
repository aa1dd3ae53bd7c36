#include "physics/wheel_drive.h"

#include <algorithm>

namespace odolab {

WheelDrive::WheelDrive(const Motor& motor, double radius_m, double carried_inertia_kgm2)
    : motor_(motor), radius_m_(radius_m), carried_inertia_kgm2_(carried_inertia_kgm2) {}

double WheelDrive::advance(double set_speed_radps, double traction_n, double step_s) {
  if (motor_.ideal) {
    turn_at(set_speed_radps, step_s);
    return set_speed_radps;
  }
  const double error_radps = set_speed_radps - speed_radps_;
  const double wanted_nm =
      motor_.proportional_gain * error_radps + motor_.integral_gain * (lag_rad_ + error_radps * step_s);
  const double torque_nm = std::clamp(wanted_nm, -motor_.torque_limit_nm, motor_.torque_limit_nm);
  if (torque_nm == wanted_nm) lag_rad_ += error_radps * step_s;  // a saturated motor does not wind up

  // The traction is that of the step before. Taken as it stands it would make a light wheel on a heavy vehicle
  // unstable; the part of it that accelerates the vehicle is therefore predicted and only the rest is taken from the
  // step before.
  const double load_nm = radius_m_ * traction_n - carried_inertia_kgm2_ * acceleration_radps2_;
  acceleration_radps2_ = (torque_nm - load_nm) / (motor_.wheel_inertia_kgm2 + carried_inertia_kgm2_);
  const double mean_radps = speed_radps_ + 0.5 * acceleration_radps2_ * step_s;
  speed_radps_ += acceleration_radps2_ * step_s;
  rotation_rad_ += mean_radps * step_s;
  return mean_radps;
}

void WheelDrive::turn_at(double speed_radps, double step_s) {
  acceleration_radps2_ = 0.0;
  speed_radps_ = speed_radps;
  rotation_rad_ += speed_radps * step_s;
}

}  // namespace odolab
