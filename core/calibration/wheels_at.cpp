#include "core/calibration/wheels_at.h"

namespace odolab {

WheelSample wheels_at(const std::vector<WheelSample>& wheels, double time_s) {
  if (time_s > wheels.back().time_s) return {time_s, wheels.back().left_rad, wheels.back().right_rad};
  const auto [after, share] = place_between(wheels, time_s);
  const WheelSample &a = wheels[after - 1], &b = wheels[after];
  return {time_s, a.left_rad + share * (b.left_rad - a.left_rad), a.right_rad + share * (b.right_rad - a.right_rad)};
}

}  // namespace odolab
