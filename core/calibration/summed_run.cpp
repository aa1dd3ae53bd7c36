// The wheels between two truth samples, summed up: README.md in this folder, Eqs. 2 to 6.
#include <Eigen/Dense>
#include <cmath>

#include "core/calibration/innovations.h"
#include "core/calibration/pose_covariance.h"
#include "core/calibration/wheel_line.h"

namespace odolab {

namespace {

using Eigen::Vector3d;

// A wheel on which the vehicle pivots scrubs: this share of its noise comes from the other wheel's way. Without it such
// turns would be believed without end.
constexpr double kScrub = 0.3;
}  // namespace

SummedRun summed_up(const InnovationRun& run, const InnovationModel& model) {
  const DifferentialDrive& drive = model.drive;
  const double b = drive.wheelbase_m;
  const int extras = static_cast<int>(run.extra.size());
  const int p = column::first_extra + extras;
  const double count = count_rad(run, drive);
  SummedRun summed;
  summed.columns = p;
  summed.motions.resize(run.truth.size() - 1);
  summed.derivatives.assign(3 * static_cast<std::size_t>(p) * summed.motions.size(), 0.0);

  WheelLine line(run.wheels, run.speeds_are_held);
  const bool smoothed = !run.smooth.empty();
  const WheelLine smooth_line(smoothed ? run.smooth : run.wheels, run.speeds_are_held);
  const auto time_of = [&](std::size_t truth_index) {
    return run.truth[truth_index].time_s - model.truth.time_offset_s;
  };
  double now_s = time_of(0);
  std::size_t i = line.interval_at(now_s);

  for (std::size_t t = 0; t < summed.motions.size(); ++t) {
    RelativeMotion& out = summed.motions[t];
    double* const jac = &summed.derivatives[3 * static_cast<std::size_t>(p) * t];
    const double end_s = time_of(t + 1);
    PoseCovariance wheel_noise, body_noise, sideways_noise, count_noise;
    const bool body_is_noisy = model.noise.body_m_per_sqrt_m > 0.0;
    bool counts_left_behind = false;
    Pose& pose = out.motion;

    // Body velocity at the start: the clock's derivative needs it at both ends.
    Vector3d velocity;
    const auto velocity_in = [&](std::size_t interval, double time_s) {
      const WheelRates rate = smooth_line.rates(interval, time_s);
      const double left = drive.wheel_radius_left_m * rate.left_radps,
                   right = drive.wheel_radius_right_m * rate.right_radps;
      Vector3d v(0.5 * (right + left), 0.0, (right - left) / b);
      const double dt = run.wheels[interval + 1].time_s - run.wheels[interval].time_s;
      for (const ExtraColumn& e : run.extra)
        if (e.value != 0.0)
          v += e.value / dt *
               Vector3d(e.per_step[interval].forward_m, e.per_step[interval].sideways_m, e.per_step[interval].turn_rad);
      return v;
    };
    i = line.interval_at(now_s);
    const Vector3d start_velocity = velocity_in(i, now_s);

    while (now_s < end_s) {
      i = line.interval_at(now_s);
      const bool last_interval = i + 2 >= run.wheels.size();
      const double until_s = last_interval ? end_s : std::min(end_s, run.wheels[i + 1].time_s);
      const WheelSample &w0 = run.wheels[i], &w1 = run.wheels[i + 1];
      const double share = (until_s - now_s) / (w1.time_s - w0.time_s);
      const auto [left_before, right_before] = line.turned_rad(i, now_s);
      const auto [left_then, right_then] = line.turned_rad(i, until_s);
      const double left_rad = left_then - left_before, right_rad = right_then - right_before;
      const double left_m = drive.wheel_radius_left_m * left_rad, right_m = drive.wheel_radius_right_m * right_rad;

      // README, Eq. 3: what the wheels say and what the extra columns add.
      const double wheel_turn = (right_m - left_m) / b;
      double forward = 0.5 * (right_m + left_m), sideways = 0.0, turn = wheel_turn;
      for (const ExtraColumn& e : run.extra) {
        if (e.value == 0.0) continue;
        forward += share * e.value * e.per_step[i].forward_m;
        sideways += share * e.value * e.per_step[i].sideways_m;
        turn += share * e.value * e.per_step[i].turn_rad;
      }
      const double middle = pose.heading_rad + 0.5 * turn;
      const double c = std::cos(middle), s = std::sin(middle);
      const double dx = forward * c - sideways * s, dy = forward * s + sideways * c;

      // Derivatives, Eq. 4: of the old pose by its own heading, and of the step by forward, sideways and turn.
      const auto carry = [&](double* d, double f, double l, double w) {
        d[0] += -dy * d[2] + c * f - s * l - 0.5 * dy * w;
        d[1] += dx * d[2] + s * f + c * l + 0.5 * dx * w;
        d[2] += w;
      };
      double left_d = left_rad, right_d = right_rad;
      if (smoothed) {
        const auto [left_0, right_0] = smooth_line.turned_rad(i, now_s);
        const auto [left_1, right_1] = smooth_line.turned_rad(i, until_s);
        left_d = left_1 - left_0;
        right_d = right_1 - right_0;
      }
      carry(jac + 3 * column::wheel_radius_left, 0.5 * left_d, 0.0, -left_d / b);
      carry(jac + 3 * column::wheel_radius_right, 0.5 * right_d, 0.0, right_d / b);
      carry(jac + 3 * column::wheelbase, 0.0, 0.0,
            -(drive.wheel_radius_right_m * right_d - drive.wheel_radius_left_m * left_d) / (b * b));
      for (int e = 0; e < extras; ++e) {
        const BodyMotion& m = run.extra[e].per_step[i];
        carry(jac + 3 * (column::first_extra + e), share * m.forward_m, share * m.sideways_m, share * m.turn_rad);
      }

      // Noise of both wheels, Eq. 5.
      const Vector3d by_left(0.5 * c + 0.5 * dy / b, 0.5 * s - 0.5 * dx / b, -1.0 / b);
      const Vector3d by_right(0.5 * c - 0.5 * dy / b, 0.5 * s + 0.5 * dx / b, 1.0 / b);
      wheel_noise = wheel_noise.carried(dx, dy);
      const double way_m = 0.5 * (std::abs(left_m) + std::abs(right_m));
      const double left_way_m = (1.0 - kScrub) * std::abs(left_m) + kScrub * way_m;
      const double right_way_m = (1.0 - kScrub) * std::abs(right_m) + kScrub * way_m;
      wheel_noise.add(left_way_m, by_left(0), by_left(1), by_left(2));
      wheel_noise.add(right_way_m, by_right(0), by_right(1), by_right(2));
      if (body_is_noisy) {
        body_noise = body_noise.carried(dx, dy);
        sideways_noise = sideways_noise.carried(dx, dy);
        body_noise.add(way_m, c, s, 0.0);
        body_noise.add(way_m, -dy / b, dx / b, 2.0 / b);  // the turn
        sideways_noise.add(way_m, -s, c, 0.0);
      }
      if (counts_left_behind) count_noise = count_noise.carried(dx, dy);
      if (!run.settles.empty() && run.settles[i] && now_s == w0.time_s) {
        if (run.settles[i] & 1) {
          const double m = count * drive.wheel_radius_left_m;
          count_noise.add(m * m / 12.0, by_left(0), by_left(1), by_left(2));
          counts_left_behind = true;
        }
        if (run.settles[i] & 2) {
          const double m = count * drive.wheel_radius_right_m;
          count_noise.add(m * m / 12.0, by_right(0), by_right(1), by_right(2));
          counts_left_behind = true;
        }
      }
      pose = {pose.x_m + dx, pose.y_m + dy, pose.heading_rad + turn};
      now_s = until_s;
    }
    velocity = velocity_in(i, end_s);
    const double c_end = std::cos(pose.heading_rad), s_end = std::sin(pose.heading_rad);
    const Vector3d moved_end(c_end * velocity(0) - s_end * velocity(1), s_end * velocity(0) + c_end * velocity(1),
                             velocity(2));
    double* const clock = jac + 3 * column::truth_clock;  // Eq. 6: both ends move back in time
    clock[0] += start_velocity(0) - start_velocity(2) * pose.y_m - moved_end(0);
    clock[1] += start_velocity(1) + start_velocity(2) * pose.x_m - moved_end(1);
    clock[2] += start_velocity(2) - moved_end(2);
    for (int k = 0; k < 3; ++k) summed.end_velocity.push_back(moved_end(k));
    wheel_noise.pack(out.wheel_noise);
    body_noise.pack(out.body_noise);
    sideways_noise.pack(out.sideways_noise);
    count_noise.pack(out.count_noise);
  }
  return summed;
}
}  // namespace odolab
