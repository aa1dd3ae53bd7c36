#include "core/odometry/cast_rejection.h"

#include <Eigen/Dense>
#include <cassert>
#include <cmath>

namespace odolab {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// What one castor says about the body's motion (dx, dy, dpsi) of an interval: the way of its pivot, and its turn by its
// wheels less that by its pivot encoder. `model` maps the motion to these three readings.
struct Testimony {
  Matrix3d model;
  Vector3d reading;
  Matrix3d information;  // inverse covariance

  double disagreement(const Vector3d& motion) const {
    const Vector3d residual = reading - model * motion;
    return residual.dot(information * residual);
  }
};

Testimony testimony(const Castor& castor, const CastorReading& before, const CastorReading& now, const Pose& body,
                    const MultiCastor& vehicle, double turn_guess_rad, const CastOptions& options,
                    const RejectionOptions& rejection) {
  const CastorMotion motion = castor_motion(castor, before, now);
  const Vec2 way = pivot_way(castor, motion, body.heading_rad, options.heading);
  const Vec2 arm = rotated(castor.pivot(), body.heading_rad + 0.5 * turn_guess_rad);
  Testimony t;
  t.model << 1.0, 0.0, -arm.y_m, 0.0, 1.0, arm.x_m, 0.0, 0.0, 1.0;  // Eqs. 13, 14
  t.reading << way.x_m, way.y_m, motion.turn_rad - motion.swivel_rad;
  // Rounding at both ends of the interval, and a share of the distance, on each wheel; both move (travel, turn).
  const auto variance = [&](double radius_m, double rotation_rad) {
    const double rounding_m = radius_m * vehicle.wheel_encoder_resolution_rad;
    const double share_m = rejection.distance_share * radius_m * rotation_rad;
    return rounding_m * rounding_m / 6.0 + share_m * share_m;
  };
  const double left = variance(castor.wheel_radius_left_m, now.wheels.left_rad - before.wheels.left_rad);
  const double right = variance(castor.wheel_radius_right_m, now.wheels.right_rad - before.wheels.right_rad);
  const double heading_rad = body.heading_rad + motion.heading_rad + 0.5 * motion.turn_rad;
  const double c = std::cos(heading_rad), s = std::sin(heading_rad), track_m = castor.track_m();
  const auto effect_of = [&](double other_offset_m, double sign) {
    const double travel = other_offset_m / track_m, turn = sign / track_m;
    return Vector3d(travel * c - castor.offset_m * turn * s, travel * s + castor.offset_m * turn * c, turn);
  };
  const Vector3d by_left = effect_of(castor.wheel_offset_right_m, -1.0);
  const Vector3d by_right = effect_of(castor.wheel_offset_left_m, 1.0);
  const double step_rad = vehicle.pivot_encoder_resolution_rad;
  // The pivot's rounding turns the whole way of the castor, and its difference enters the turn.
  const Vector3d by_pivot_at_start(-way.y_m, way.x_m, 1.0), by_pivot_at_end(0.0, 0.0, -1.0);
  const double pivot_variance = step_rad * step_rad / 12.0;
  Matrix3d covariance = left * by_left * by_left.transpose() + right * by_right * by_right.transpose() +
                        pivot_variance * (by_pivot_at_start * by_pivot_at_start.transpose() +
                                          by_pivot_at_end * by_pivot_at_end.transpose());
  // Where in the interval the castor swung round is not known: its travel was laid down somewhere between both
  // headings.
  const double aside_m = motion.travel_m * motion.turn_rad;
  const Vector3d aside(-s, c, 0.0);
  covariance += aside_m * aside_m / 12.0 * aside * aside.transpose();
  covariance += Vector3d(1e-12, 1e-12, 1e-12).asDiagonal();  // a micrometre: ideal encoders at rest
  t.information = covariance.inverse();
  return t;
}

struct Agreement {
  Vector3d motion = Vector3d::Zero();
  double disagreement = 0.0;
};

// The motion that the witnesses who are heard agree on best, and how much they disagree about it.
Agreement agreement(const std::vector<Testimony>& all, const std::vector<char>& unheard) {
  Matrix3d information = Matrix3d::Zero();
  Vector3d score = Vector3d::Zero();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (unheard[i]) continue;
    information += all[i].model.transpose() * all[i].information * all[i].model;
    score += all[i].model.transpose() * all[i].information * all[i].reading;
  }
  Agreement result;
  result.motion = information.inverse() * score;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!unheard[i]) result.disagreement += all[i].disagreement(result.motion);
  return result;
}

int heard(const std::vector<char>& unheard) {
  int count = 0;
  for (char u : unheard) count += u ? 0 : 1;
  return count;
}

// The castor without which the others agree; none where they agree anyhow, or where no single one explains it.
int suspect(const std::vector<Testimony>& all, const std::vector<char>& unheard, const RejectionOptions& rejection) {
  if (heard(unheard) < 3 || agreement(all, unheard).disagreement <= rejection.contradiction) return -1;
  int found = -1;
  double least = rejection.agreement;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (unheard[i]) continue;
    std::vector<char> without = unheard;
    without[i] = 1;
    const double disagreement = agreement(all, without).disagreement;
    if (disagreement < least) {
      least = disagreement;
      found = static_cast<int>(i);
    }
  }
  return found;
}

}  // namespace

RejectingCast::RejectingCast(const MultiCastor& vehicle, const Pose& start, const CastOptions& options,
                             const RejectionOptions& rejection)
    : vehicle_(vehicle),
      options_(options),
      rejection_(rejection),
      left_out_(vehicle.castors.size(), 0),
      quiet_(vehicle.castors.size(), 0),
      since_s_(vehicle.castors.size(), 0.0),
      body_(start) {
  assert(problem_in(options, vehicle).empty());
  if (options.left_out > 0) left_out_[static_cast<std::size_t>(options.left_out - 1)] = 1;
  unheard_ = left_out_;
}

void RejectingCast::take(const CastorSample& now) {
  const CastorSample before = last_;
  last_ = now;
  if (before.castors.empty()) return;
  const std::size_t n = vehicle_.castors.size();
  // Where the vehicle turned to without suspicion; good enough to linearise at.
  const Pose guess =
      moved_by_pivots(body_, pivot_ways(vehicle_, before, now, body_, options_.heading, unheard_), options_);
  std::vector<Testimony> all;
  for (std::size_t i = 0; i < n; ++i)
    all.push_back(testimony(vehicle_.castors[i], before.castors[i], now.castors[i], body_, vehicle_,
                            guess.heading_rad - body_.heading_rad, options_, rejection_));
  if (const int found = suspect(all, unheard_, rejection_); found >= 0) {
    const std::size_t i = static_cast<std::size_t>(found);
    unheard_[i] = 1;
    quiet_[i] = 0;
    since_s_[i] = before.time_s;
  }
  const Vector3d motion = agreement(all, unheard_).motion;
  body_ = moved_by_pivots(body_, pivot_ways(vehicle_, before, now, body_, options_.heading, unheard_), options_);
  for (std::size_t i = 0; i < n; ++i) {
    if (!unheard_[i] || left_out_[i]) continue;
    quiet_[i] = all[i].disagreement(motion) < rejection_.back_below ? quiet_[i] + 1 : 0;
    if (quiet_[i] < rejection_.back_after) continue;
    unheard_[i] = 0;
    disregarded_.push_back({static_cast<int>(i) + 1, since_s_[i], now.time_s});
  }
}

void RejectingCast::finish() {
  for (std::size_t i = 0; i < unheard_.size(); ++i)
    if (unheard_[i] && !left_out_[i]) disregarded_.push_back({static_cast<int>(i) + 1, since_s_[i], last_.time_s});
  unheard_ = left_out_;
}

RejectingTrack castor_track_with_rejection(const std::vector<CastorSample>& samples, const MultiCastor& vehicle,
                                           const Pose& start, const CastOptions& options,
                                           const RejectionOptions& rejection) {
  RejectingCast cast(vehicle, start, options, rejection);
  RejectingTrack result;
  for (const CastorSample& sample : samples) {
    cast.take(sample);
    result.track.push_back({sample.time_s, cast.body()});
  }
  cast.finish();
  result.disregarded = cast.disregarded();
  return result;
}

}  // namespace odolab
