#include "core/calibration/lasting_truth_filter.h"

#include <cmath>

#include "core/calibration/unknown_heading.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d matrix_of(const PoseCovariance& c) {
  Matrix3d m;
  m << c.xx, c.xy, c.xh, c.xy, c.yy, c.yh, c.xh, c.yh, c.hh;
  return m;
}

double square(double value) { return value * value; }

// The pose's rows of what (dx, dy) in the room carries on.
template <typename Matrix>
void carry_rows(Matrix& of, double dx, double dy) {
  of.row(0) -= dy * of.row(2);
  of.row(1) += dx * of.row(2);
}

template <typename Matrix>
void carry_columns(Matrix& of, double dx, double dy) {
  of.col(0) -= dy * of.col(2);
  of.col(1) += dx * of.col(2);
}

}  // namespace

LastingTruthFilter::LastingTruthFilter(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                                       const FilterOptions& options)
    : run_(run), summed_(summed), model_(model), options_(options), count_error_(count_error(run, model.drive)) {
  const double half_s = 0.5 * model.noise.wander_lasts_s;
  off_position2_ = square(model.noise.wander_m_per_sqrt_s) * half_s;
  off_heading2_ = run.truth_has_heading ? square(model.noise.heading_wander_rad_per_sqrt_s) * half_s : 0.0;
}

InnovationSums LastingTruthFilter::run() {
  walk(run_, options_, *this, sums_);
  return std::move(sums_);
}

NoiseSlopes LastingTruthFilter::slopes() {
  with_slopes_ = true;
  walk(run_, options_, *this, sums_);
  slopes_.value = sums_.chi2 + sums_.log_determinant;
  slopes_.scalars = sums_.scalars;
  return slopes_;
}

double LastingTruthFilter::variance_of(int k) const {
  return run_.truth_variance.empty() ? 1.0 : run_.truth_variance[static_cast<std::size_t>(k)];
}

Vec2 LastingTruthFilter::arm() const {
  const Pose& m = model_.truth.axle_T_tracked;
  return {facing_.c * m.x_m - facing_.s * m.y_m, facing_.s * m.x_m + facing_.c * m.y_m};
}

void LastingTruthFilter::turn(double by_rad) {
  pose_.heading_rad += by_rad;
  facing_ = turn_of(pose_.heading_rad);
}

void LastingTruthFilter::report_step(int k) {
  if (!options_.on_step) return;
  step_.truth_index = k;
  step_.pose = pose_;
  options_.on_step(step_);
  step_ = FilterStep{};
}

template <typename Of>
Eigen::Matrix<double, 3, Of::ColsAtCompileTime> LastingTruthFilter::read_of(const Of& of, Vec2 arm,
                                                                            bool has_heading) const {
  Eigen::Matrix<double, 3, Of::ColsAtCompileTime> read;
  read.row(0) = of.row(0) - arm.y_m * of.row(2) + of.row(3);
  read.row(1) = of.row(1) + arm.x_m * of.row(2) + of.row(4);
  if (has_heading)
    read.row(2) = of.row(2) + of.row(5);
  else
    read.row(2).setZero();
  return read;
}

// README, Eq. 7a: the start is the truth sample with its error, less what the frame is off, of which nothing is known.
void LastingTruthFilter::begin_at(int k) {
  const TruthSample& truth = run_.truth[k];
  const Pose& m = model_.truth.axle_T_tracked;
  const double times = variance_of(k), position2 = times * square(model_.noise.truth_position_m);
  double heading2 = times * square(model_.noise.truth_heading_rad), tracked_heading;
  const bool heading_is_read = run_.truth_has_heading && truth.heading_rad;
  if (heading_is_read) {
    tracked_heading = *truth.heading_rad;
  } else {
    const int last = options_.last < 0 ? static_cast<int>(run_.truth.size()) : options_.last;
    const UnknownHeading unknown = heading_from_shape(run_, summed_, model_, k, last);
    tracked_heading = unknown.guess_rad + m.heading_rad;
    heading2 = square(unknown.stderr_rad);
    sums_.log_determinant -= std::log(heading2);
  }
  pose_.heading_rad = tracked_heading - m.heading_rad;
  facing_ = turn_of(pose_.heading_rad);
  const Vec2 arm = this->arm();
  pose_.x_m = truth.position.x_m - arm.x_m;
  pose_.y_m = truth.position.y_m - arm.y_m;
  off_.setZero();
  // Of the pose as it is read and of the frame; then back from the point to the axle.
  const auto spread = [&](double of_position, double of_heading, double off_position, double off_heading) {
    const double off_of_read = heading_is_read ? off_heading : 0.0;
    Covariance c = Covariance::Zero();
    c.diagonal() << of_position + off_position, of_position + off_position, of_heading + off_of_read, off_position,
        off_position, off_heading;
    c(0, 3) = c(3, 0) = c(1, 4) = c(4, 1) = -off_position;
    c(2, 5) = c(5, 2) = -off_of_read;
    carry_rows(c, -arm.x_m, -arm.y_m);
    carry_columns(c, -arm.x_m, -arm.y_m);
    return c;
  };
  covariance_ = spread(position2, heading2, off_position2_, off_heading2_);
  covariance_.topLeftCorner<3, 3>() += matrix_of(count_error_.times(times).turned(facing_.c, facing_.s));
  if (with_slopes_) {
    slope_of_.fill(Slope{});
    slope_of_[noise_size::position].covariance = spread(2.0 * position2, 0.0, 0.0, 0.0);
    slope_of_[noise_size::heading].covariance = spread(0.0, heading_is_read ? 2.0 * heading2 : 0.0, 0.0, 0.0);
    slope_of_[noise_size::wander].covariance = spread(0.0, 0.0, 2.0 * off_position2_, 0.0);
    slope_of_[noise_size::heading_wander].covariance = spread(0.0, 0.0, 0.0, 2.0 * off_heading2_);
  }
  if (!options_.on_step) return;
  step_ = FilterStep{};
  step_.starts = true;
  step_.heading_before_rad = step_.heading_rad = pose_.heading_rad;
  step_.arm = arm;
  report_step(k);
}

void LastingTruthFilter::predict(int t) {
  const RelativeMotion& step = summed_.motions[t];
  const FittedNoise& noise = model_.noise;
  const double c = facing_.c, s = facing_.s;
  const double dx = c * step.motion.x_m - s * step.motion.y_m, dy = s * step.motion.x_m + c * step.motion.y_m;
  const double decay = std::exp(-(run_.truth[t + 1].time_s - run_.truth[t].time_s) / noise.wander_lasts_s);
  const double anew = 1.0 - decay * decay;
  const auto carry = [&](Covariance& of) {
    carry_rows(of, dx, dy);
    carry_columns(of, dx, dy);
    of.bottomRows<3>() *= decay;
    of.rightCols<3>() *= decay;
  };
  carry(covariance_);
  covariance_.diagonal().tail<3>() += anew * Vector3d(off_position2_, off_position2_, off_heading2_);
  covariance_.topLeftCorner<3, 3>() += matrix_of(PoseCovariance::packed(step.count_noise).turned(c, s));
  if (with_slopes_)
    for (Slope& of : slope_of_) {
      carry(of.covariance);
      of.state.head<2>() += Eigen::Vector2d(-dy, dx) * of.state(2);
      of.state.tail<3>() *= decay;
    }
  const auto grow = [&](int size, const double* packed, double of_one) {
    if (of_one == 0.0) return;
    const Matrix3d by = of_one * of_one * matrix_of(PoseCovariance::packed(packed).turned(c, s));
    covariance_.topLeftCorner<3, 3>() += by;
    if (with_slopes_) slope_of_[static_cast<std::size_t>(size)].covariance.topLeftCorner<3, 3>() += 2.0 * by;
  };
  grow(noise_size::wheel, step.wheel_noise, noise.wheel_m_per_sqrt_m);
  grow(noise_size::along, step.along_noise, noise.along_m_per_sqrt_m);
  grow(noise_size::turning, step.turning_noise, noise.turning_m_per_sqrt_m);
  grow(noise_size::sideways, step.sideways_noise, noise.sideways_m_per_sqrt_m);
  grow(noise_size::command_timing, step.timing_noise, noise.command_timing_s);
  if (with_slopes_) {
    slope_of_[noise_size::wander].covariance(3, 3) += 2.0 * anew * off_position2_;
    slope_of_[noise_size::wander].covariance(4, 4) += 2.0 * anew * off_position2_;
    slope_of_[noise_size::heading_wander].covariance(5, 5) += 2.0 * anew * off_heading2_;
  }
  if (options_.on_step) {
    step_.moved = {dx, dy};
    step_.heading_before_rad = pose_.heading_rad;
    step_.truth_decay = decay;
  }
  pose_.x_m += dx;
  pose_.y_m += dy;
  off_ *= decay;
  turn(step.motion.heading_rad);
  step_.heading_rad = pose_.heading_rad;
}

bool LastingTruthFilter::update(int k) {
  const TruthSample& truth = run_.truth[k];
  const Pose& m = model_.truth.axle_T_tracked;
  const Vec2 arm = this->arm();
  const bool has_heading = truth.heading_rad && run_.truth_has_heading;
  const Vector3d residual(
      truth.position.x_m - pose_.x_m - arm.x_m - off_(0), truth.position.y_m - pose_.y_m - arm.y_m - off_(1),
      has_heading ? wrapped(*truth.heading_rad - pose_.heading_rad - m.heading_rad - off_(2)) : 0.0);
  const double times = variance_of(k), position2 = times * square(model_.noise.truth_position_m),
               heading2 = times * square(model_.noise.truth_heading_rad);
  const Gain seen = read_of(covariance_, arm, has_heading).transpose();  // P H'
  PoseCovariance rounding = count_error_.times(times).turned(facing_.c, facing_.s).carried(arm.x_m, arm.y_m);
  if (!has_heading) rounding.xh = rounding.yh = rounding.hh = 0.0;
  Matrix3d s = read_of(seen, arm, has_heading) + matrix_of(rounding);
  s.diagonal() += Vector3d(position2, position2, has_heading ? heading2 : 1.0);
  const Eigen::LLT<Matrix3d> llt(s);
  const Matrix3d weight = llt.solve(Matrix3d::Identity());
  const Vector3d white = llt.matrixL().solve(residual);
  const double squared = white.squaredNorm();
  const bool refused = options_.gate > 0.0 && squared > (has_heading ? options_.gate : 0.9 * options_.gate);
  const PoseCovariance covariance{s(0, 0), s(0, 1), s(0, 2), s(1, 1), s(1, 2), s(2, 2)};
  const int n = has_heading ? 3 : 2;
  if (options_.on_innovation)
    options_.on_innovation(
        innovation_of(truth.time_s, k, n, residual.data(), white.data(), covariance, squared, refused));
  if (refused) {
    sums_.set_aside[k] = 1;
    report_step(k);
    return false;
  }
  sums_.chi2 += squared;
  sums_.log_determinant += 2.0 * std::log(llt.matrixLLT().diagonal().prod());
  sums_.scalars += n;
  const Gain gain = seen * weight;
  if (with_slopes_) carry_slopes(gain, weight, residual, arm, position2, heading2, has_heading);
  covariance_ -= gain * seen.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  const State by = gain * residual;
  pose_.x_m += by(0);
  pose_.y_m += by(1);
  turn(by(2));
  off_ += by.tail<3>();
  if (options_.on_step) {
    step_.used = true;
    step_.size = n;
    step_.arm = arm;
    covariance.pack(step_.covariance);
    for (int r = 0; r < 3; ++r) {
      step_.residual[r] = residual(r);
      for (int c = 0; c < 3; ++c) step_.gain[3 * r + c] = gain(r, c), step_.truth_gain[3 * r + c] = gain(r + 3, c);
    }
    report_step(k);
  }
  return true;
}

// README, Eq. 9a, with S whole instead of its factor.
void LastingTruthFilter::carry_slopes(const Gain& gain, const Matrix3d& weight, const Vector3d& residual, Vec2 arm,
                                      double position2, double heading2, bool has_heading) {
  constexpr auto kSizes = static_cast<std::size_t>(noise_size::count);
  std::array<Matrix3d, kSizes> of_s;   // S^-1 S'
  std::array<Vector3d, kSizes> of_nu;  // nu'
  const Vector3d weighed = weight * residual;
  for (std::size_t i = 0; i < kSizes; ++i) {
    Slope& of = slope_of_[i];
    const Gain of_seen = read_of(of.covariance, arm, has_heading).transpose();
    Matrix3d s = read_of(of_seen, arm, has_heading);
    if (i == noise_size::position) s.diagonal().head<2>().array() += 2.0 * position2;
    if (i == noise_size::heading && has_heading) s(2, 2) += 2.0 * heading2;
    of_nu[i] = -read_of(of.state, arm, has_heading);
    of_s[i] = weight * s;
    slopes_.slope[i] += of_s[i].trace() + 2.0 * weighed.dot(of_nu[i]) - weighed.dot(s * weighed);
    const Gain of_gain = (of_seen - gain * s) * weight;
    of.state += of_gain * residual + gain * of_nu[i];
    const Covariance lost = of_seen * gain.transpose();
    of.covariance += gain * s * gain.transpose() - lost - lost.transpose();
  }
  for (std::size_t i = 0; i < kSizes; ++i)
    for (std::size_t j = 0; j < kSizes; ++j)
      slopes_.curvature[kSizes * i + j] +=
          (of_s[i].transpose().cwiseProduct(of_s[j])).sum() + 2.0 * of_nu[i].dot(weight * of_nu[j]);
}

}  // namespace odolab
