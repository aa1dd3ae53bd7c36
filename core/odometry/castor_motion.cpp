#include "core/odometry/castor_motion.h"

#include <cmath>

namespace odolab {

CastorMotion castor_motion(const Castor& castor, const CastorReading& before, const CastorReading& now) {
  const double left_m = castor.wheel_radius_left_m * (now.wheels.left_rad - before.wheels.left_rad);
  const double right_m = castor.wheel_radius_right_m * (now.wheels.right_rad - before.wheels.right_rad);
  CastorMotion motion;
  // The wheels stand at different distances from the line through the pivot, so their mean is weighted.
  motion.travel_m = (castor.wheel_offset_left_m * right_m + castor.wheel_offset_right_m * left_m) / castor.track_m();
  motion.turn_rad = (right_m - left_m) / castor.track_m();
  motion.swivel_rad = wrapped(now.pivot_rad - before.pivot_rad);
  motion.heading_rad = before.pivot_rad - castor.pivot_encoder_offset_rad;
  return motion;
}

Vec2 pivot_way(const Castor& castor, const CastorMotion& motion, double body_heading_rad, HeadingRule rule) {
  const double start_rad = body_heading_rad + motion.heading_rad, end_rad = start_rad + motion.turn_rad;
  const double travel_rad = rule == HeadingRule::middle ? start_rad + 0.5 * motion.turn_rad : end_rad;
  const Vec2 axle = motion.travel_m * Vec2{std::cos(travel_rad), std::sin(travel_rad)};
  const Vec2 about_axle = castor.offset_m * Vec2{std::cos(end_rad) - std::cos(start_rad),  //
                                                 std::sin(end_rad) - std::sin(start_rad)};
  return axle + about_axle;
}

}  // namespace odolab
