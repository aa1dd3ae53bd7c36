// The wheels between two truth samples, summed up: README.md in this folder, Eqs. 2 to 6.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/calibration/innovations.h"
#include "core/calibration/pose_covariance.h"
#include "core/calibration/wheel_line.h"
#include "core/geometry/small_turn.h"

namespace odolab {

namespace {

// A wheel on which the vehicle pivots scrubs: this share of its noise comes from the other wheel's way. Without it such
// turns would be believed without end.
constexpr double kScrub = 0.3;

// Both wheels, as they are read and as they are smoothed for derivatives.
struct Rotation {
  double left = 0.0, right = 0.0, left_smooth = 0.0, right_smooth = 0.0;
};

// How far both wheels turn, there and back, for what goes by it.
struct Ways {
  double left, right;
};

// Times are asked for in order; that at which one stretch ends begins the next, and is reckoned once.
class Rotations {
 public:
  Rotations(const InnovationRun& run, double count)
      : run_(run),
        smoothed_(!run.smooth.empty()),
        few_counts_(count > 0.0 && !run.speeds_are_held && moves_by(run.wheels) < kFewCounts * count),
        line_(run.wheels, run.speeds_are_held),
        smooth_(smoothed_ ? run.smooth : run.wheels, run.speeds_are_held) {}

  std::size_t interval_at(double time_s) { return line_.interval_at(time_s); }

  // Between two times within interval i.
  Rotation between(std::size_t i, double from_s, double to_s) {
    const WheelSample &a = run_.wheels[i], &b = run_.wheels[i + 1];
    if (from_s == a.time_s && to_s == b.time_s) {
      const WheelSample &c = smoothed_ ? run_.smooth[i] : a, &d = smoothed_ ? run_.smooth[i + 1] : b;
      return {b.left_rad - a.left_rad, b.right_rad - a.right_rad, d.left_rad - c.left_rad, d.right_rad - c.right_rad};
    }
    const Rotation before = at(i, from_s), then = at(i, to_s);
    return {then.left - before.left, then.right - before.right, then.left_smooth - before.left_smooth,
            then.right_smooth - before.right_smooth};
  }

  // Of a part of interval i that lasts so long. Where readings are a few counts apart the mean of five: it ends at
  // others than this one does. Noise that goes by what is read would believe those more that are a count too short, and
  // radii come out large.
  Ways ways(std::size_t i, const Rotation& read, double lasts_s) const {
    if (!few_counts_) return {std::abs(read.left), std::abs(read.right)};
    constexpr std::size_t kToEitherSide = 2;
    const WheelSample &first = run_.wheels[i - std::min(i, kToEitherSide)],
                      &last = run_.wheels[std::min(i + 1 + kToEitherSide, run_.wheels.size() - 1)];
    const double share = lasts_s / (last.time_s - first.time_s);
    return {share * std::abs(last.left_rad - first.left_rad), share * std::abs(last.right_rad - first.right_rad)};
  }

  // At a time within interval i, for derivatives.
  WheelRates rates(std::size_t i, double time_s) {
    if (i != rates_in_ || time_s != rates_at_s_) {
      rates_ = smooth_.rates(i, time_s);
      rates_in_ = i;
      rates_at_s_ = time_s;
    }
    return rates_;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  static constexpr double kFewCounts = 8.0;

  // How far a wheel that turns does so from one reading to the next, in the mean.
  static double moves_by(const std::vector<WheelSample>& wheels) {
    double sum_rad = 0.0, moves = 0.0;
    for (std::size_t i = 0; i + 1 < wheels.size(); ++i)
      for (double WheelSample::*wheel : {&WheelSample::left_rad, &WheelSample::right_rad}) {
        const double by_rad = std::abs(wheels[i + 1].*wheel - wheels[i].*wheel);
        sum_rad += by_rad;
        moves += by_rad > 0.0 ? 1.0 : 0.0;
      }
    return sum_rad / std::max(1.0, moves);
  }

  // Since sample i.
  Rotation at(std::size_t i, double time_s) {
    if (i == last_in_ && time_s == last_at_s_) return last_;
    if (time_s == run_.wheels[i].time_s) return {};
    const auto [left, right] = line_.turned_rad(i, time_s);
    last_ = {left, right, left, right};
    if (smoothed_) {
      const auto [left_smooth, right_smooth] = smooth_.turned_rad(i, time_s);
      last_.left_smooth = left_smooth;
      last_.right_smooth = right_smooth;
    }
    last_in_ = i;
    last_at_s_ = time_s;
    return last_;
  }

  const InnovationRun& run_;
  bool smoothed_, few_counts_;
  WheelLine line_, smooth_;
  Rotation last_;
  std::size_t last_in_ = kNone, rates_in_ = kNone;
  double last_at_s_ = 0.0, rates_at_s_ = 0.0;
  WheelRates rates_;
};

// Noise of both wheels and of the body, Eq. 5, for sizes of 1 m per root metre. With a half of the forward motion and q
// half of what a turn of a metre at the wheel does, the left wheel moves the pose by a - q, the right one by a + q, the
// body forward by 2 a and in its turn by 2 q: all are sums of a a' + q q' and of a q' + q a'.
class RollingNoise {
 public:
  // A step by (dx, dy) at a heading of that cosine and sine, in which the wheels went so far there and back.
  void add(double left_m, double right_m, const Turn& heading, double dx, double dy, double inverse_base) {
    const double way_m = 0.5 * (left_m + right_m), more_m = (1.0 - kScrub) * (right_m - left_m);
    const double ax = 0.5 * heading.c, ay = 0.5 * heading.s;
    const double qx = -0.5 * dy * inverse_base, qy = 0.5 * dx * inverse_base, qh = inverse_base;
    along_.xx += way_m * (ax * ax);
    along_.xy += way_m * (ax * ay);
    along_.yy += way_m * (ay * ay);
    turning_ = turning_.carried(dx, dy);
    turning_.xx += way_m * (qx * qx);
    turning_.xy += way_m * (qx * qy);
    turning_.xh += way_m * (qx * qh);
    turning_.yy += way_m * (qy * qy);
    turning_.yh += way_m * (qy * qh);
    turning_.hh += way_m * (qh * qh);
    uneven_ = uneven_.carried(dx, dy);
    uneven_.xx += more_m * (2.0 * ax * qx);
    uneven_.xy += more_m * (ax * qy + ay * qx);
    uneven_.xh += more_m * (ax * qh);
    uneven_.yy += more_m * (2.0 * ay * qy);
    uneven_.yh += more_m * (ay * qh);
    sideways_.xx += way_m * (heading.s * heading.s);
    sideways_.xy -= way_m * (heading.s * heading.c);
    sideways_.yy += way_m * (heading.c * heading.c);
  }
  void pack(RelativeMotion& out, bool body_is_noisy) const {
    PoseCovariance wheels = along_.times(2.0);
    wheels.add(turning_.times(2.0));
    wheels.add(uneven_);
    wheels.pack(out.wheel_noise);
    if (!body_is_noisy) return;
    along_.times(4.0).pack(out.along_noise);
    turning_.times(4.0).pack(out.turning_noise);
    sideways_.pack(out.sideways_noise);
  }

 private:
  PoseCovariance along_, turning_, uneven_, sideways_;
};

// Each change of a command is acted on a second too late or too soon: of what the body's velocity changes from one
// motion to the next. That shows in the motions about the change until it is acted on, so it is spread over them. What
// changes within one motion and is back does not count.
void add_timing_noise(SummedRun& summed, const InnovationRun& run) {
  constexpr double kSpread_s = 0.2, kGap_s = 1.0;
  const auto& truth = run.truth;
  const std::size_t n = summed.motions.size();
  const auto velocity = [&](std::size_t t) {
    const double took_s = truth[t + 1].time_s - truth[t].time_s;
    const Pose& m = summed.motions[t].motion;
    return std::array{m.x_m / took_s, m.y_m / took_s, m.heading_rad / took_s};
  };
  std::vector<PoseCovariance> noise(n);
  std::vector<double> share;
  for (std::size_t t = 1; t < n; ++t) {
    const double before_s = truth[t].time_s - truth[t - 1].time_s, behind_s = truth[t + 1].time_s - truth[t].time_s;
    if (is_cut(run, t) || before_s + behind_s > kGap_s) continue;
    const double spread_s = std::max({kSpread_s, before_s, behind_s});
    const auto share_of = [&](std::size_t m) {
      return 1.0 - std::abs(0.5 * (truth[m].time_s + truth[m + 1].time_s) - truth[t].time_s) / spread_s;
    };
    std::size_t first = t - 1, last = t;
    while (first > 0 && share_of(first - 1) > 0.0) --first;
    while (last + 1 < n && share_of(last + 1) > 0.0) ++last;
    share.clear();
    double all = 0.0;
    for (std::size_t m = first; m <= last; ++m) all += share.emplace_back(share_of(m));
    const auto was = velocity(t - 1), is = velocity(t);
    for (std::size_t m = first; m <= last; ++m)
      noise[m].add(share[m - first] / all, is[0] - was[0], is[1] - was[1], is[2] - was[2]);
  }
  for (std::size_t m = 0; m < n; ++m) noise[m].pack(summed.motions[m].timing_noise);
}

}  // namespace

SummedRun summed_up(const InnovationRun& run, const InnovationModel& model) {
  using Eigen::Vector3d;
  using Columns = Eigen::Array4d;  // of both radii and the wheelbase, and one that stays empty
  const DifferentialDrive& drive = model.drive;
  const double b = drive.wheelbase_m, inverse_base = 1.0 / b;
  const double left_radius_m = drive.wheel_radius_left_m, right_radius_m = drive.wheel_radius_right_m;
  const int extras = static_cast<int>(run.extra.size());
  const int p = column::first_extra + extras;
  const double count = count_rad(run, drive);
  const bool body_is_noisy = model.noise.along_m_per_sqrt_m > 0.0;
  SummedRun summed;
  summed.columns = p;
  summed.motions.resize(run.truth.size() - 1);
  summed.derivatives.assign(3 * static_cast<std::size_t>(p) * summed.motions.size(), 0.0);
  summed.end_velocity.resize(3 * summed.motions.size());

  Rotations rotations(run, count);
  const auto time_of = [&](std::size_t truth_index) {
    return run.truth[truth_index].time_s - model.truth.time_offset_s;
  };
  // Of the body: the clock's derivative needs it at both ends of a motion.
  const auto velocity_in = [&](std::size_t interval, double time_s) {
    const WheelRates rate = rotations.rates(interval, time_s);
    const double left = left_radius_m * rate.left_radps, right = right_radius_m * rate.right_radps;
    Vector3d v(0.5 * (right + left), 0.0, (right - left) * inverse_base);
    for (const ExtraColumn& e : run.extra)
      if (e.value != 0.0)
        v += e.value / (run.wheels[interval + 1].time_s - run.wheels[interval].time_s) *
             Vector3d(e.per_step[interval].forward_m, e.per_step[interval].sideways_m, e.per_step[interval].turn_rad);
    return v;
  };
  // Of what turns on a long way from one reading to the next, where the next piece of the interval begins: wheels that
  // speed up leave the arc that both ends would say. Read at 10 Hz, a wheelbase came out 0.1 % too small without.
  const auto next_piece = [&](std::size_t interval, double at_s) {
    constexpr double kPiece_rad = 0.01, kPiece_s = 0.02;
    const WheelSample &a = run.wheels[interval], &b = run.wheels[interval + 1];
    const double turn =
        (right_radius_m * (b.right_rad - a.right_rad) - left_radius_m * (b.left_rad - a.left_rad)) * inverse_base;
    const double pieces = std::ceil(std::min(std::abs(turn) / kPiece_rad, (b.time_s - a.time_s) / kPiece_s));
    if (!(pieces > 1.0) || run.speeds_are_held) return b.time_s;
    const double piece_s = (b.time_s - a.time_s) / pieces;
    // Stamps since 1970 are known to a quarter of a microsecond: what lies so near an end of a piece is at that end.
    constexpr double kOfAPiece = 1e-3;
    const double next_s = a.time_s + piece_s * (std::floor((at_s - a.time_s) / piece_s + kOfAPiece) + 1.0);
    return next_s < b.time_s - 0.5 * piece_s ? next_s : b.time_s;
  };
  double now_s = time_of(0);
  std::size_t i = 0;

  for (std::size_t t = 0; t < summed.motions.size(); ++t) {
    RelativeMotion& out = summed.motions[t];
    double* const jac = &summed.derivatives[3 * static_cast<std::size_t>(p) * t];
    const double end_s = time_of(t + 1);
    RollingNoise rolling_noise;
    PoseCovariance count_noise;
    bool counts_left_behind = false;
    Pose& pose = out.motion;
    Columns by_x = Columns::Zero(), by_y = Columns::Zero(), by_heading = Columns::Zero();

    i = rotations.interval_at(now_s);
    const Vector3d start_velocity = velocity_in(i, now_s);

    while (now_s < end_s) {
      i = rotations.interval_at(now_s);
      const bool last_interval = i + 2 >= run.wheels.size();
      const double until_s = last_interval ? end_s : std::min({end_s, run.wheels[i + 1].time_s, next_piece(i, now_s)});
      const Rotation rad = rotations.between(i, now_s, until_s);
      const double left_m = left_radius_m * rad.left, right_m = right_radius_m * rad.right;

      // README, Eq. 3: what the wheels say and what the extra columns add.
      double forward = 0.5 * (right_m + left_m), sideways = 0.0, turn = (right_m - left_m) * inverse_base;
      const double share = extras > 0 ? (until_s - now_s) / (run.wheels[i + 1].time_s - run.wheels[i].time_s) : 0.0;
      for (const ExtraColumn& e : run.extra) {
        if (e.value == 0.0) continue;
        forward += share * e.value * e.per_step[i].forward_m;
        sideways += share * e.value * e.per_step[i].sideways_m;
        turn += share * e.value * e.per_step[i].turn_rad;
      }
      const Turn middle = turn_of(pose.heading_rad + 0.5 * turn);
      const double chord = chord_share(turn), c = chord * middle.c, s = chord * middle.s;
      const double dx = forward * c - sideways * s, dy = forward * s + sideways * c;

      // Derivatives, Eq. 4: of the old pose by its own heading, and of the step by forward and turn; and sideways.
      const double left_turn = rad.left_smooth * inverse_base, right_turn = rad.right_smooth * inverse_base;
      const Columns by_forward(0.5 * rad.left_smooth, 0.5 * rad.right_smooth, 0.0, 0.0);
      const Columns by_turn(-left_turn, right_turn,
                            -(right_radius_m * right_turn - left_radius_m * left_turn) * inverse_base, 0.0);
      const Columns by_middle = by_heading + 0.5 * by_turn;
      const double slope = chord_share_slope(turn);
      by_x += c * by_forward - dy * by_middle + slope * dx * by_turn;
      by_y += s * by_forward + dx * by_middle + slope * dy * by_turn;
      by_heading += by_turn;
      for (int e = 0; e < extras; ++e) {
        const BodyMotion& m = run.extra[e].per_step[i];
        const double f = share * m.forward_m, l = share * m.sideways_m, w = share * m.turn_rad;
        double* const d = jac + 3 * (column::first_extra + e);
        d[0] += -dy * d[2] + c * f - s * l + (slope * dx - 0.5 * dy) * w;
        d[1] += dx * d[2] + s * f + c * l + (slope * dy + 0.5 * dx) * w;
        d[2] += w;
      }

      const Ways ways = rotations.ways(i, rad, until_s - now_s);
      rolling_noise.add(left_radius_m * ways.left, right_radius_m * ways.right, middle, dx, dy, inverse_base);
      if (counts_left_behind) count_noise = count_noise.carried(dx, dy);
      if (!run.settles.empty() && run.settles[i] && now_s == run.wheels[i].time_s) {
        for (const double side : {-1.0, 1.0}) {  // left, right
          if (!(run.settles[i] & (side < 0.0 ? 1 : 2))) continue;
          const double m = count * (side < 0.0 ? left_radius_m : right_radius_m);
          const double half = 0.5 * side * inverse_base;
          count_noise.add(m * m / 12.0, 0.5 * c - half * dy, 0.5 * s + half * dx, 2.0 * half);
          counts_left_behind = true;
        }
      }
      pose = {pose.x_m + dx, pose.y_m + dy, pose.heading_rad + turn};
      now_s = until_s;
    }
    for (int k = 0; k < 3; ++k) {
      double* const d = jac + 3 * k;
      d[0] = by_x(k), d[1] = by_y(k), d[2] = by_heading(k);
    }
    const Vector3d velocity = velocity_in(i, end_s);
    const Turn end = turn_of(pose.heading_rad);
    const double moved_end[3] = {end.c * velocity(0) - end.s * velocity(1), end.s * velocity(0) + end.c * velocity(1),
                                 velocity(2)};
    double* const clock = jac + 3 * column::truth_clock;  // Eq. 6: both ends move back in time
    clock[0] = start_velocity(0) - start_velocity(2) * pose.y_m - moved_end[0];
    clock[1] = start_velocity(1) + start_velocity(2) * pose.x_m - moved_end[1];
    clock[2] = start_velocity(2) - moved_end[2];
    for (std::size_t k = 0; k < 3; ++k) summed.end_velocity[3 * t + k] = moved_end[k];
    rolling_noise.pack(out, body_is_noisy);
    count_noise.pack(out.count_noise);
  }
  if (run.speeds_are_held) add_timing_noise(summed, run);
  return summed;
}
}  // namespace odolab
