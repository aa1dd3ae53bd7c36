#include "core/calibration/innovations.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/calibration/rests.h"
#include "core/calibration/smoothed_readings.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void add_symmetric(const Matrix3d& m, double* packed) {
  packed[0] += m(0, 0);
  packed[1] += m(0, 1);
  packed[2] += m(0, 2);
  packed[3] += m(1, 1);
  packed[4] += m(1, 2);
  packed[5] += m(2, 2);
}

Matrix3d symmetric(const double* packed) {
  Matrix3d m;
  m << packed[0], packed[1], packed[2], packed[1], packed[3], packed[4], packed[2], packed[4], packed[5];
  return m;
}

Matrix3d rotation(double heading_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  Matrix3d r;
  r << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return r;
}

// Whether rotations are whole counts: interpolated or ideal ones are not, and have no rounding error.
bool lie_on_counts(const std::vector<WheelSample>& wheels, const DifferentialDrive& drive) {
  const double counts_per_rad = drive.counts_per_wheel_turn() / (2.0 * kPi);
  std::size_t on = 0;
  const auto whole = [&](double rad, double first_rad) {
    const double counts = (rad - first_rad) * counts_per_rad;
    return std::abs(counts - std::round(counts)) < 0.01;
  };
  for (const WheelSample& w : wheels)
    on += whole(w.left_rad, wheels.front().left_rad) && whole(w.right_rad, wheels.front().right_rad);
  return static_cast<double>(on) > 0.95 * static_cast<double>(wheels.size());
}

// Truth that repeats itself to the last bit while the wheels drive on is not a measurement.
int leave_out_frozen(std::vector<TruthSample>& truth, const std::vector<WheelSample>& wheels, const Vehicle& vehicle) {
  const DifferentialDrive& drive = std::get<DifferentialDrive>(vehicle.kind);
  std::vector<TruthSample> kept;
  std::size_t k = 0;
  std::vector<double> rolled_m(wheels.size(), 0.0);
  for (std::size_t i = 1; i < wheels.size(); ++i)
    rolled_m[i] = rolled_m[i - 1] +
                  0.5 * drive.wheel_radius_left_m * std::abs(wheels[i].left_rad - wheels[i - 1].left_rad) +
                  0.5 * drive.wheel_radius_right_m * std::abs(wheels[i].right_rad - wheels[i - 1].right_rad);
  const auto rolled_at = [&](double time_s) {
    while (k + 1 < wheels.size() && wheels[k].time_s < time_s) ++k;
    return rolled_m[k];
  };
  for (std::size_t i = 0; i < truth.size();) {
    std::size_t j = i + 1;
    while (j < truth.size() && truth[j].position.x_m == truth[i].position.x_m &&
           truth[j].position.y_m == truth[i].position.y_m && truth[j].heading_rad == truth[i].heading_rad)
      ++j;
    const double before_m = rolled_at(truth[i].time_s);
    const bool frozen = j - i >= 3 && rolled_at(truth[j - 1].time_s) - before_m > 0.02;
    for (std::size_t n = i; n < j; ++n)
      if (!frozen || n == i) kept.push_back(truth[n]);
    i = j;
  }
  const int left_out = static_cast<int>(truth.size() - kept.size());
  truth = std::move(kept);
  return left_out;
}

// Rotation of the wheels at any time, linear between samples and beyond the ends.
struct Rates {
  double left_radps = 0.0, right_radps = 0.0;
};

class WheelLine {
 public:
  WheelLine(const std::vector<WheelSample>& wheels, bool held) : wheels_(wheels), held_(held) {}
  // The interval that holds the time: i for [i, i + 1]. Times are asked for in order.
  std::size_t interval_at(double time_s) {
    while (i_ + 2 < wheels_.size() && wheels_[i_ + 1].time_s <= time_s) ++i_;
    return i_;
  }
  // At a time within interval i: the derivative of turned_rad.
  Rates rates(std::size_t i, double time_s) const {
    const WheelSample &a = wheels_[i], &b = wheels_[i + 1];
    const double dt = b.time_s - a.time_s, u = (time_s - a.time_s) / dt;
    const Rates even{(b.left_rad - a.left_rad) / dt, (b.right_rad - a.right_rad) / dt};
    if (held_ || u < 0.0 || u > 1.0) return even;
    const auto bent = [&](double by, double slope_a, double slope_b) {
      if (by == 0.0) return 0.0;
      return (3.0 * u * u - 4.0 * u + 1.0) * slope_a + 6.0 * (u - u * u) * by + (3.0 * u * u - 2.0 * u) * slope_b;
    };
    const Rates at_a = slope(i), at_b = slope(i + 1);
    return {bent(even.left_radps, at_a.left_radps, at_b.left_radps),
            bent(even.right_radps, at_a.right_radps, at_b.right_radps)};
  }
  // Rotation of each wheel since sample i, at a time within the interval behind it.
  std::pair<double, double> turned_rad(std::size_t i, double time_s) const {
    const WheelSample &a = wheels_[i], &b = wheels_[i + 1];
    const double dt = b.time_s - a.time_s, u = (time_s - a.time_s) / dt;
    const double left = b.left_rad - a.left_rad, right = b.right_rad - a.right_rad;
    if (held_ || u <= 0.0 || u >= 1.0) return {u * left, u * right};
    // A wheel that speeds up lags behind the straight line between two samples. Cubic, slopes from both neighbours.
    const auto bent = [&](double by, double slope_a, double slope_b) {
      if (by == 0.0) return 0.0;
      const double u2 = u * u, u3 = u2 * u;
      return (u3 - 2.0 * u2 + u) * dt * slope_a + (3.0 * u2 - 2.0 * u3) * by + (u3 - u2) * dt * slope_b;
    };
    const Rates at_a = slope(i), at_b = slope(i + 1);
    return {bent(left, at_a.left_radps, at_b.left_radps), bent(right, at_a.right_radps, at_b.right_radps)};
  }

 private:
  Rates slope(std::size_t i) const {
    const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, wheels_.size() - 1);
    const double dt = wheels_[after].time_s - wheels_[before].time_s;
    return {(wheels_[after].left_rad - wheels_[before].left_rad) / dt,
            (wheels_[after].right_rad - wheels_[before].right_rad) / dt};
  }

  const std::vector<WheelSample>& wheels_;
  bool held_;
  std::size_t i_ = 0;
};

}  // namespace

Result<InnovationRun> innovation_run(const Recording& recording, const Vehicle& vehicle) {
  const DifferentialDrive& drive = std::get<DifferentialDrive>(vehicle.kind);
  const std::string where = recording.name.empty() ? "recording" : recording.name;
  if (const std::vector<std::string> problems = problems_in(recording); !problems.empty())
    return Error{where, "", problems.front()};
  InnovationRun run;
  run.name = where;
  for (const WheelSample& w : wheel_samples(recording, drive))
    if (run.wheels.empty() || w.time_s > run.wheels.back().time_s) run.wheels.push_back(w);
  if (run.wheels.size() < 2)
    return Error{where, "no wheel rotation", "left_wheel_rad and right_wheel_rad, or left_ticks and right_ticks"};

  // Truth may reach one wheel sample beyond the wheels: there the wheels are taken to go on as they did.
  const double span_s = run.wheels.back().time_s - run.wheels.front().time_s;
  const double beyond_s = span_s / static_cast<double>(run.wheels.size() - 1) + 1e-9;
  std::vector<TruthSample> truth;
  for (const TruthSample& t : truth_samples(recording)) {
    const double time_s = t.time_s - vehicle.truth.time_offset_s;
    if (time_s < run.wheels.front().time_s - beyond_s || time_s > run.wheels.back().time_s + beyond_s) continue;
    if (truth.empty() || t.time_s > truth.back().time_s) truth.push_back(t);
  }
  run.frozen = leave_out_frozen(truth, run.wheels, vehicle);
  const auto with_heading =
      std::count_if(truth.begin(), truth.end(), [](const TruthSample& t) { return t.heading_rad.has_value(); });
  run.truth_has_heading = 2 * with_heading > static_cast<std::ptrdiff_t>(truth.size());
  for (const TruthSample& t : truth) {
    if (run.truth.empty() && run.truth_has_heading && !t.heading_rad)
      continue;  // a start needs a heading where there is one
    run.truth.push_back(t);
    if (!run.truth_has_heading) run.truth.back().heading_rad.reset();
  }
  if (run.truth.size() < 2)
    return Error{where, std::to_string(run.truth.size()) + " truth samples within the time of the wheels",
                 "two or more of truth_x_m and truth_y_m"};
  run.set_aside.assign(run.truth.size(), 0);
  run.counts_show = lie_on_counts(run.wheels, drive);
  run.smooth = smoothed(run.wheels);
  if (run.counts_show) {
    run.settles.assign(run.wheels.size() - 1, 0);
    for (std::size_t i = 1; i + 1 < run.wheels.size(); ++i) {  // the first count behind a pause, however short
      const WheelSample &before = run.wheels[i - 1], &here = run.wheels[i], &next = run.wheels[i + 1];
      if (here.left_rad == before.left_rad && next.left_rad != here.left_rad) run.settles[i] |= 1;
      if (here.right_rad == before.right_rad && next.right_rad != here.right_rad) run.settles[i] |= 2;
    }
    for (const RestEdge& e : rest_edges(run.wheels, &WheelSample::left_rad)) run.settles[e.interval] |= 1;
    for (const RestEdge& e : rest_edges(run.wheels, &WheelSample::right_rad)) run.settles[e.interval] |= 2;
  }
  return run;
}

std::vector<DriveStep> drive_steps(const InnovationRun& run, const DifferentialDrive& drive) {
  std::vector<DriveStep> steps;
  steps.reserve(run.wheels.size() - 1);
  Pose pose{run.truth.front().position.x_m, run.truth.front().position.y_m,
            run.truth.front().heading_rad.value_or(0.0)};
  for (std::size_t i = 0; i + 1 < run.wheels.size(); ++i) {
    const WheelSample &a = run.wheels[i], &b = run.wheels[i + 1];
    DriveStep step;
    step.time_s = 0.5 * (a.time_s + b.time_s);
    step.duration_s = b.time_s - a.time_s;
    step.left_m = drive.wheel_radius_left_m * (b.left_rad - a.left_rad);
    step.right_m = drive.wheel_radius_right_m * (b.right_rad - a.right_rad);
    step.turn_rad = (step.right_m - step.left_m) / drive.wheelbase_m;
    const Pose next = dead_reckoned(pose, b.left_rad - a.left_rad, b.right_rad - a.right_rad, drive);
    step.heading_rad = pose.heading_rad + 0.5 * step.turn_rad;
    step.position = 0.5 * (pose.position() + next.position());
    pose = next;
    steps.push_back(step);
  }
  return steps;
}

// A wheel on which the vehicle pivots scrubs: this share of its noise comes from the other wheel's way. Without it such
// turns would be believed without end.
constexpr double kScrub = 0.3;

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
    Matrix3d wheel_noise = Matrix3d::Zero(), body_noise = Matrix3d::Zero(), sideways_noise = Matrix3d::Zero(),
             count_noise = Matrix3d::Zero();
    const bool body_is_noisy = model.noise.body_m_per_sqrt_m > 0.0;
    bool counts_left_behind = false;
    Pose& pose = out.motion;

    // Body velocity at the start: the clock's derivative needs it at both ends.
    Vector3d velocity;
    const auto velocity_in = [&](std::size_t interval, double time_s) {
      const Rates rate = smooth_line.rates(interval, time_s);
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
      Matrix3d f = Matrix3d::Identity();
      f(0, 2) = -dy;
      f(1, 2) = dx;
      const Vector3d by_left(0.5 * c + 0.5 * dy / b, 0.5 * s - 0.5 * dx / b, -1.0 / b);
      const Vector3d by_right(0.5 * c - 0.5 * dy / b, 0.5 * s + 0.5 * dx / b, 1.0 / b);
      const auto carry_noise = [&](Matrix3d& m) {  // f m f' without the multiplications by 0 and 1
        for (int k = 0; k < 3; ++k) {
          m(0, k) += f(0, 2) * m(2, k);
          m(1, k) += f(1, 2) * m(2, k);
        }
        for (int k = 0; k < 3; ++k) {
          m(k, 0) += f(0, 2) * m(k, 2);
          m(k, 1) += f(1, 2) * m(k, 2);
        }
      };
      carry_noise(wheel_noise);
      const double way_m = 0.5 * (std::abs(left_m) + std::abs(right_m));
      const double left_way_m = (1.0 - kScrub) * std::abs(left_m) + kScrub * way_m;
      const double right_way_m = (1.0 - kScrub) * std::abs(right_m) + kScrub * way_m;
      wheel_noise.noalias() += by_left * (left_way_m * by_left.transpose());
      wheel_noise.noalias() += by_right * (right_way_m * by_right.transpose());
      if (body_is_noisy) {
        carry_noise(body_noise);
        carry_noise(sideways_noise);
        const Vector3d by_turn = (2.0 / b) * Vector3d(-0.5 * dy, 0.5 * dx, 1.0);
        const Vector3d by_forward(c, s, 0.0), by_sideways(-s, c, 0.0);
        body_noise.noalias() += by_forward * (way_m * by_forward.transpose());
        body_noise.noalias() += by_turn * (way_m * by_turn.transpose());
        sideways_noise.noalias() += by_sideways * (way_m * by_sideways.transpose());
      }
      if (counts_left_behind) carry_noise(count_noise);
      if (!run.settles.empty() && run.settles[i] && now_s == w0.time_s) {
        if (run.settles[i] & 1) {
          const double m = count * drive.wheel_radius_left_m;
          count_noise += by_left * (m * m / 12.0 * by_left.transpose());
          counts_left_behind = true;
        }
        if (run.settles[i] & 2) {
          const double m = count * drive.wheel_radius_right_m;
          count_noise += by_right * (m * m / 12.0 * by_right.transpose());
          counts_left_behind = true;
        }
      }
      pose = {pose.x_m + dx, pose.y_m + dy, pose.heading_rad + turn};
      now_s = until_s;
    }
    velocity = velocity_in(i, end_s);
    const Vector3d moved_end = rotation(pose.heading_rad) * velocity;
    double* const clock = jac + 3 * column::truth_clock;  // Eq. 6: both ends move back in time
    clock[0] += start_velocity(0) - start_velocity(2) * pose.y_m - moved_end(0);
    clock[1] += start_velocity(1) + start_velocity(2) * pose.x_m - moved_end(1);
    clock[2] += start_velocity(2) - moved_end(2);
    for (int k = 0; k < 3; ++k) summed.end_velocity.push_back(moved_end(k));
    add_symmetric(wheel_noise, out.wheel_noise);
    if (body_is_noisy) add_symmetric(body_noise, out.body_noise);
    if (body_is_noisy) add_symmetric(sideways_noise, out.sideways_noise);
    if (counts_left_behind) add_symmetric(count_noise, out.count_noise);
  }
  return summed;
}

namespace {

// The heading that lays the first metres of dead reckoning onto a truth without headings.
double heading_from_shape(const InnovationRun& run, const SummedRun& summed, const TruthMounting& mounting, int first,
                          int last) {
  double cosine = 0.0, sine = 0.0, travelled = 0.0;
  Pose pose;
  const Vec2 m = mounting.axle_T_tracked.position(), start = pose * m;
  for (int t = first; t + 1 < last; ++t) {
    pose = pose * summed.motions[t].motion;
    travelled += length(summed.motions[t].motion.position());
    if (run.set_aside[t + 1]) continue;
    const Vec2 guess = pose * m - start, truth = run.truth[t + 1].position - run.truth[first].position;
    cosine += dot(guess, truth);
    sine += cross(guess, truth);
    if (travelled > 2.0 && std::hypot(cosine, sine) > 0.5) break;
  }
  return std::atan2(sine, cosine);
}

class PoseFilter {
 public:
  PoseFilter(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
             const FilterOptions& options)
      : run_(run),
        summed_(summed),
        model_(model),
        options_(options),
        p_(options.derivatives ? summed.columns : 0),
        last_(options.last < 0 ? static_cast<int>(run.truth.size()) : options.last),
        jacobian_(3, p_) {
    derivative_.setZero(3, p_);
    information_.setZero(p_, p_);
    score_.setZero(p_);
    const DifferentialDrive& drive = model.drive;
    const double count = count_rad(run, drive);
    const double left = std::pow(count * drive.wheel_radius_left_m, 2) / 12.0,
                 right = std::pow(count * drive.wheel_radius_right_m, 2) / 12.0;
    const double b = drive.wheelbase_m;
    count_error_ << 0.25 * (left + right), 0.0, 0.5 * (right - left) / b, 0.0, 0.0, 0.0, 0.5 * (right - left) / b, 0.0,
        (left + right) / (b * b);
    reading_ = Vector3d(model.noise.truth_position_m * model.noise.truth_position_m,
                        model.noise.truth_position_m * model.noise.truth_position_m,
                        model.noise.truth_heading_rad * model.noise.truth_heading_rad);
  }

  InnovationSums run() {
    sums_.set_aside = options_.gate > 0.0 ? std::vector<char>(run_.truth.size(), 0) : run_.set_aside;
    int start = options_.first;
    if (options_.gate <= 0.0)
      while (start + 1 < last_ && run_.set_aside[start]) ++start;
    begin_at(start);
    int refused = 0;
    for (int t = start; t + 1 < last_; ++t) {
      predict(t);
      const int k = t + 1;
      if (options_.gate <= 0.0 && run_.set_aside[k]) {
        refused = run_.set_aside[k] == kRestartHere ? 0 : refused;
        if (run_.set_aside[k] == kRestartHere) begin_at(k);
        if (run_.set_aside[k] != kRestartHere) report_step(k);
        continue;
      }
      if (update(k)) {
        refused = 0;
      } else if (++refused >= 20) {
        begin_at(k);
        sums_.set_aside[k] = kRestartHere;
        ++sums_.restarts;
        refused = 0;
      }
    }
    sums_.information.assign(information_.data(), information_.data() + information_.size());
    sums_.score.assign(score_.data(), score_.data() + score_.size());
    if (p_ > 0) {  // only one half was summed
      for (int r = 0; r < p_; ++r)
        for (int c = 0; c < r; ++c) sums_.information[c * p_ + r] = sums_.information[r * p_ + c] = information_(r, c);
    }
    return std::move(sums_);
  }

 private:
  static constexpr char kRestartHere = 2;

  // README, Eq. 7: the start is the truth sample itself, with its error.
  void begin_at(int k) {
    place_at(k);
    if (!options_.on_step) return;
    step_ = FilterStep{};
    step_.starts = true;
    step_.heading_before_rad = step_.heading_rad = state_.heading_rad;
    step_.arm = rotated(model_.truth.axle_T_tracked.position(), state_.heading_rad);
    report_step(k);
  }

  void report_step(int k) {
    if (!options_.on_step) return;
    step_.truth_index = k;
    step_.pose = state_;
    options_.on_step(step_);
    step_ = FilterStep{};
  }

  void place_at(int k) {
    const TruthSample& truth = run_.truth[k];
    const Pose& m = model_.truth.axle_T_tracked;
    Vector3d error = reading_;
    double tracked_heading;
    if (run_.truth_has_heading && truth.heading_rad) {
      tracked_heading = *truth.heading_rad;
    } else {
      tracked_heading = heading_from_shape(run_, summed_, model_.truth, k, last_) + m.heading_rad;
      error(2) = 1.0;  // unknown: an error of one radian
    }
    const double heading = tracked_heading - m.heading_rad;
    const Vec2 arm = rotated(m.position(), heading);
    state_ = {truth.position.x_m - arm.x_m, truth.position.y_m - arm.y_m, heading};
    Matrix3d back = Matrix3d::Identity();  // of the pose by the reading
    back(0, 2) = arm.y_m;
    back(1, 2) = -arm.x_m;
    const Matrix3d turn = rotation(heading);
    covariance_ = back * error.asDiagonal() * back.transpose() + turn * count_error_ * turn.transpose();
    if (p_ == 0) return;
    derivative_.setZero();
    const double c = std::cos(heading), s = std::sin(heading);
    derivative_.col(column::mounting_x) << -c, -s, 0.0;
    derivative_.col(column::mounting_y) << s, -c, 0.0;
    if (run_.truth_has_heading) derivative_.col(column::mounting_heading) << -arm.y_m, arm.x_m, -1.0;
  }

  void predict(int t) {
    const RelativeMotion& step = summed_.motions[t];
    const double c = std::cos(state_.heading_rad), s = std::sin(state_.heading_rad);
    const double dx = c * step.motion.x_m - s * step.motion.y_m, dy = s * step.motion.x_m + c * step.motion.y_m;
    const double* jac = p_ > 0 ? &summed_.derivatives[3 * static_cast<std::size_t>(p_) * t] : nullptr;
    for (int k = 0; k < p_; ++k, jac += 3) {
      double* d = &derivative_(0, k);
      d[0] += -dy * d[2] + c * jac[0] - s * jac[1];
      d[1] += dx * d[2] + s * jac[0] + c * jac[1];
      d[2] += jac[2];
    }
    Matrix3d f = Matrix3d::Identity();
    f(0, 2) = -dy;
    f(1, 2) = dx;
    const double q2 = model_.noise.wheel_m_per_sqrt_m * model_.noise.wheel_m_per_sqrt_m;
    double noise[6];
    const double body2 = model_.noise.body_m_per_sqrt_m * model_.noise.body_m_per_sqrt_m;
    const double side2 = model_.noise.sideways_m_per_sqrt_m * model_.noise.sideways_m_per_sqrt_m;
    for (int k = 0; k < 6; ++k)
      noise[k] =
          q2 * step.wheel_noise[k] + body2 * step.body_noise[k] + side2 * step.sideways_noise[k] + step.count_noise[k];
    Matrix3d turn;
    turn << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
    covariance_ = f * covariance_ * f.transpose() + turn * symmetric(noise) * turn.transpose();
    if (options_.on_step) {
      step_.moved = {dx, dy};
      step_.heading_before_rad = state_.heading_rad;
    }
    state_ = {state_.x_m + dx, state_.y_m + dy, state_.heading_rad + step.motion.heading_rad};
    step_.heading_rad = state_.heading_rad;
  }

  // README, Eqs. 8 and 9. False where the gate refuses the sample.
  bool update(int k) {
    const TruthSample& truth = run_.truth[k];
    const Pose& m = model_.truth.axle_T_tracked;
    const Vec2 arm = rotated(m.position(), state_.heading_rad);
    const int n = truth.heading_rad && run_.truth_has_heading ? 3 : 2;
    Vector3d residual(truth.position.x_m - state_.x_m - arm.x_m, truth.position.y_m - state_.y_m - arm.y_m,
                      n == 3 ? wrapped(*truth.heading_rad - state_.heading_rad - m.heading_rad) : 0.0);
    Matrix3d h = Matrix3d::Identity();
    h(0, 2) = -arm.y_m;
    h(1, 2) = arm.x_m;
    const Matrix3d turn = rotation(state_.heading_rad);
    const Matrix3d predicted = covariance_ + turn * count_error_ * turn.transpose();
    Matrix3d s = h * predicted * h.transpose();
    s.diagonal() += reading_;
    if (n == 2) {  // a heading that was not read: infinitely uncertain, and no residual
      s.row(2).setZero();
      s.col(2).setZero();
      s(2, 2) = 1.0;
    }
    // Cholesky factor of S by hand: lower l, S = l l'.
    const double l00 = std::sqrt(s(0, 0)), l10 = s(1, 0) / l00, l20 = s(2, 0) / l00;
    const double l11 = std::sqrt(std::max(s(1, 1) - l10 * l10, 1e-300)), l21 = (s(2, 1) - l20 * l10) / l11;
    const double l22 = std::sqrt(std::max(s(2, 2) - l20 * l20 - l21 * l21, 1e-300));
    const auto whiten = [&](double* v) {
      v[0] /= l00;
      v[1] = (v[1] - l10 * v[0]) / l11;
      v[2] = (v[2] - l20 * v[0] - l21 * v[1]) / l22;
    };
    Vector3d white = residual;
    whiten(white.data());
    const double squared = white.squaredNorm();
    const bool refused = options_.gate > 0.0 && squared > (n == 3 ? options_.gate : 0.9 * options_.gate);
    if (options_.on_innovation) {
      Innovation out;
      out.time_s = truth.time_s;
      out.truth_index = k;
      out.size = n;
      for (int j = 0; j < 3; ++j) {
        out.residual[j] = residual(j);
        out.white[j] = white(j);
      }
      add_symmetric(s, out.covariance);
      out.squared = squared;
      out.set_aside = refused;
      options_.on_innovation(out);
    }
    if (refused) {
      sums_.set_aside[k] = 1;
      report_step(k);
      return false;
    }
    sums_.chi2 += squared;
    sums_.log_determinant += 2.0 * (std::log(l00 * l11) + (n == 3 ? std::log(l22) : 0.0));
    sums_.scalars += n;

    // The gain acts on the error of the pose alone, not on the rounding of this very reading of the encoders: that part
    // of S is uncorrelated with the pose before and after.
    Matrix3d hc = h * covariance_;
    if (n == 2) hc.row(2).setZero();
    Matrix3d white_hc = hc;
    for (int j = 0; j < 3; ++j) whiten(&white_hc(0, j));
    const Matrix3d gain_white = white_hc.transpose();  // K = gain_white l^-1
    const Vector3d moved = gain_white * white;
    covariance_ -= gain_white * white_hc;

    if (p_ > 0) {
      const double c = std::cos(state_.heading_rad), sn = std::sin(state_.heading_rad);
      for (int j = 0; j < p_; ++j) {
        const double* d = &derivative_(0, j);
        double* o = &jacobian_(0, j);
        o[0] = d[0] - arm.y_m * d[2];
        o[1] = d[1] + arm.x_m * d[2];
        o[2] = n == 3 ? d[2] : 0.0;
      }
      jacobian_(0, column::mounting_x) += c;
      jacobian_(1, column::mounting_x) += sn;
      jacobian_(0, column::mounting_y) -= sn;
      jacobian_(1, column::mounting_y) += c;
      if (n == 3) jacobian_(2, column::mounting_heading) += 1.0;
      for (int j = 0; j < p_; ++j) whiten(&jacobian_(0, j));
      for (int r = 0; r < p_; ++r) {
        const double a0 = jacobian_(0, r), a1 = jacobian_(1, r), a2 = jacobian_(2, r);
        for (int q = 0; q <= r; ++q)
          information_(r, q) += a0 * jacobian_(0, q) + a1 * jacobian_(1, q) + a2 * jacobian_(2, q);
        score_(r) += a0 * white(0) + a1 * white(1) + a2 * white(2);
      }
      if (options_.batch > 0) {
        const std::size_t number = static_cast<std::size_t>(k / options_.batch);
        if (sums_.batch_scores.size() <= number) sums_.batch_scores.resize(number + 1, std::vector<double>(p_, 0.0));
        for (int r = 0; r < p_; ++r)
          sums_.batch_scores[number][r] +=
              jacobian_(0, r) * white(0) + jacobian_(1, r) * white(1) + jacobian_(2, r) * white(2);
      }
      derivative_.noalias() -= gain_white * jacobian_;
    }
    state_ = {state_.x_m + moved(0), state_.y_m + moved(1), state_.heading_rad + moved(2)};
    if (options_.on_step) {
      step_.used = true;
      step_.size = n;
      step_.arm = arm;
      for (int j = 0; j < 3; ++j) step_.residual[j] = residual(j);
      add_symmetric(s, step_.covariance);
      // K = gain_white l^-1, column by column from the last.
      for (int r = 0; r < 3; ++r) {
        const double g2 = gain_white(r, 2) / l22;
        const double g1 = (gain_white(r, 1) - g2 * l21) / l11;
        const double g0 = (gain_white(r, 0) - g1 * l10 - g2 * l20) / l00;
        step_.gain[3 * r] = g0;
        step_.gain[3 * r + 1] = g1;
        step_.gain[3 * r + 2] = g2;
      }
      report_step(k);
    }
    return true;
  }

  const InnovationRun& run_;
  const SummedRun& summed_;
  const InnovationModel& model_;
  const FilterOptions& options_;
  int p_;
  int last_;
  Pose state_;
  Matrix3d covariance_ = Matrix3d::Zero();
  Matrix3d count_error_;
  Vector3d reading_;
  Eigen::Matrix<double, 3, Eigen::Dynamic> derivative_, jacobian_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd score_;
  InnovationSums sums_;
  FilterStep step_;
};

}  // namespace

InnovationSums filtered(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                        const FilterOptions& options) {
  return PoseFilter(run, summed, model, options).run();
}

}  // namespace odolab
