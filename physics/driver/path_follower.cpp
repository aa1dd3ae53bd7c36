#include "physics/driver/path_follower.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr double kRest_s = 0.3;  // pause at a stop, so that the next leg starts from rest
constexpr double kApproach_s = 0.15;
// An offset from the leg is steered out over this way, or over what is driven in this time where that is longer.
constexpr double kReturnLength_m = 0.25;
constexpr double kReturnTime_s = 1.25;
constexpr double kCurvatureHaste =
    4.0;                                // between two arcs the turn rate may change so many times faster than in a turn
constexpr double kLineDone_m = 0.0005;  // a leg is done within this
constexpr double kTurnDone_rad = 0.0005;

// The speed from which an even braking ends in exactly the remaining way, reached by even acceleration from the last.
// The last stretch is approached with a time constant well above the motors', which would otherwise swing past the end.
double eased(double remaining, double largest, double acceleration, double last, double period_s) {
  const double way = std::max(0.0, remaining);
  const double braking = std::sqrt(2.0 * acceleration * way);
  return std::min({largest, braking, std::abs(last) + acceleration * period_s, way / kApproach_s});
}

// The yaw rate that brings a point which moves at `speed` back onto a line: critically damped over the way travelled.
double steering(double speed_mps, double offset_m, double heading_error_rad) {
  const double way_m = std::max(kReturnLength_m, kReturnTime_s * std::abs(speed_mps));
  return -2.0 / way_m * std::abs(speed_mps) * std::sin(heading_error_rad) - speed_mps * offset_m / (way_m * way_m);
}

}  // namespace

PathFollower::PathFollower(std::vector<Leg> route, const Driving& driving, double period_s)
    : route_(std::move(route)), driving_(driving), period_s_(period_s) {}

void PathFollower::next_leg() {
  flowing_ = !route_[leg_].stops;
  ++leg_;
  resting_s_ = 0.0;
  turned_rad_ = 0.0;
}

// A leg once done stays done, though the encoders' last count may still tremble. Counts the time at rest.
bool PathFollower::arrived(bool within_reach) {
  if (resting_s_ > 0.0 || within_reach) resting_s_ += period_s_;
  return resting_s_ > 0.0;
}

// Way on the legs behind this one that are driven without a stop.
double PathFollower::way_beyond_m() const {
  double way_m = 0.0;
  for (std::size_t i = leg_; i + 1 < route_.size() && !route_[i].stops; ++i) way_m += std::abs(route_[i + 1].length_m);
  return way_m;
}

BaseCommand PathFollower::along_line(const Leg& leg, const Pose& believed) {
  const Pose seen = between(leg.from, believed);
  const double sign = leg.length_m < 0.0 ? -1.0 : 1.0;
  const double remaining_m = std::abs(leg.length_m) - sign * seen.x_m;
  if (!leg.stops && remaining_m < kLineDone_m) {
    next_leg();
    return last_;
  }
  if (arrived(remaining_m < kLineDone_m)) return {};
  const double speed = sign * eased(remaining_m + way_beyond_m(), driving_.speed_mps, driving_.acceleration_mps2,
                                    last_.speed_mps, period_s_);
  const double wanted = steering(speed, seen.y_m, wrapped(seen.heading_rad));
  return {speed, flowing_ ? steered(wanted) : wanted};
}

// Sideways too: what is off the line is moved back, not steered back.
BaseCommand PathFollower::shifting(const Leg& leg, const Pose& believed) {
  const Vec2 along{std::cos(leg.direction_rad), std::sin(leg.direction_rad)}, across{-along.y_m, along.x_m};
  const Pose seen = between(leg.from, believed);
  const double remaining_m = leg.length_m - dot(seen.position(), along);
  if (arrived(remaining_m < kLineDone_m)) return {};
  const double last_mps = std::hypot(last_.speed_mps, last_.sideways_mps);
  const double speed = eased(remaining_m, driving_.speed_mps, driving_.acceleration_mps2, last_mps, period_s_);
  const double back_mps = -speed / std::max(kReturnLength_m, kReturnTime_s * speed) * dot(seen.position(), across);
  const Vec2 velocity = rotated(speed * along + back_mps * across, -seen.heading_rad);
  return {velocity.x_m, steering(speed, 0.0, wrapped(seen.heading_rad)), velocity.y_m};
}

BaseCommand PathFollower::turning(const Leg& leg, const Pose& believed) {
  const double sign = leg.turn_rad < 0.0 ? -1.0 : 1.0;
  const double turned_rad = believed.heading_rad - leg.from.heading_rad;  // headings are not wrapped
  const double remaining_rad = sign * (leg.turn_rad - turned_rad);
  if (arrived(remaining_rad < kTurnDone_rad)) return {};
  return {0.0, sign * eased(remaining_rad, driving_.turn_rate_radps, driving_.turn_acceleration_radps2,
                            last_.yaw_rate_radps, period_s_)};
}

BaseCommand PathFollower::around_arc(const Leg& leg, const Pose& believed) {
  const double radius_m = leg.length_m / leg.turn_rad;  // signed
  const Vec2 from_centre = believed.position() - leg.from * Vec2{0.0, radius_m};
  const double bearing_rad = std::atan2(from_centre.y_m, from_centre.x_m);
  // Turned so far, counted on across whole turns; at the beginning of the arc its start is a quarter turn behind.
  const double before_rad = leg.from.heading_rad + turned_rad_ - (radius_m > 0.0 ? 0.5 : -0.5) * kPi;
  turned_rad_ += wrapped(bearing_rad - before_rad);

  const double remaining_m = leg.length_m - radius_m * turned_rad_;
  if (!leg.stops && remaining_m < kLineDone_m) {
    next_leg();
    return last_;
  }
  if (arrived(remaining_m < kLineDone_m)) return {};
  const double speed =
      eased(remaining_m + way_beyond_m(), driving_.speed_mps, driving_.acceleration_mps2, last_.speed_mps, period_s_);
  const double left_of_arc_m = radius_m > 0.0 ? radius_m - length(from_centre) : length(from_centre) + radius_m;
  const double tangent_rad = leg.from.heading_rad + turned_rad_;
  const double wanted = speed / radius_m + steering(speed, left_of_arc_m, wrapped(believed.heading_rad - tangent_rad));
  return {speed, steered(wanted)};
}

// Between two arcs the curvature jumps; the turn rate may not.
double PathFollower::steered(double yaw_rate_radps) const {
  const double change = kCurvatureHaste * driving_.turn_acceleration_radps2 * period_s_;
  return std::clamp(yaw_rate_radps, last_.yaw_rate_radps - change, last_.yaw_rate_radps + change);
}

BaseCommand PathFollower::update(const Pose& believed) {
  if (!finished() && resting_s_ >= kRest_s) next_leg();
  if (finished()) return last_ = {};
  const Leg& leg = route_[leg_];
  switch (leg.kind) {
    case Leg::Kind::line:
      return last_ = along_line(leg, believed);
    case Leg::Kind::turn:
      return last_ = turning(leg, believed);
    case Leg::Kind::shift:
      return last_ = shifting(leg, believed);
    case Leg::Kind::arc:
      break;
  }
  return last_ = around_arc(leg, believed);
}

}  // namespace odolab
