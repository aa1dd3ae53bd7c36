// The Kalman filter over truth samples: README.md in this folder, Eqs. 7 to 9. For innovations.cpp alone, which has
// the ways to call it.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/calibration/filter_walk.h"
#include "core/calibration/innovations.h"
#include "core/calibration/noise_carry.h"
#include "core/calibration/pose_covariance.h"
#include "core/calibration/unknown_heading.h"
#include "core/geometry/small_turn.h"

namespace odolab {

// A product of determinants is that far from what a double cannot hold before its logarithm is taken.
constexpr double kSmall = 1e-100, kLarge = 1e100;

// The same as `wrapped`, sooner where there is nothing to do.
inline double soon_wrapped(double angle_rad) { return std::abs(angle_rad) < kPi ? angle_rad : wrapped(angle_rad); }

// How many columns of derivatives are carried along: none, those of a run without extra ones and one that stays empty,
// or as many as there are.
constexpr int kNoColumns = 0, kUsualColumns = column::first_extra + 1, kAnyColumns = Eigen::Dynamic;

template <int columns>
class PoseFilter {
 public:
  PoseFilter(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
             const FilterOptions& options, NoiseCarry* slopes = nullptr, const UnknownHeading* begins = nullptr)
      : run_(run),
        summed_(summed),
        model_(model),
        options_(options),
        slopes_(slopes),
        begins_(begins),
        p_(columns == kNoColumns ? 0 : summed.columns),
        last_(options.last < 0 ? static_cast<int>(run.truth.size()) : options.last) {
    const int carried = columns == kAnyColumns ? p_ : columns;
    derivative_.setZero(3, carried);
    jacobian_.setZero(3, carried);
    information_.setZero(carried, carried);
    score_.setZero(carried);
    count_error_ = count_error(run, model.drive);
    position2_ = model.noise.truth_position_m * model.noise.truth_position_m;
    heading2_ = model.noise.truth_heading_rad * model.noise.truth_heading_rad;
    wheel2_ = model.noise.wheel_m_per_sqrt_m * model.noise.wheel_m_per_sqrt_m;
    along2_ = model.noise.along_m_per_sqrt_m * model.noise.along_m_per_sqrt_m;
    turning2_ = model.noise.turning_m_per_sqrt_m * model.noise.turning_m_per_sqrt_m;
    sideways2_ = model.noise.sideways_m_per_sqrt_m * model.noise.sideways_m_per_sqrt_m;
    wander2_ = model.noise.wander_m_per_sqrt_s * model.noise.wander_m_per_sqrt_s;
    timing2_ = model.noise.command_timing_s * model.noise.command_timing_s;
    heading_wander2_ = model.noise.heading_wander_rad_per_sqrt_s * model.noise.heading_wander_rad_per_sqrt_s;
  }

  InnovationSums run() {
    walk(run_, options_, *this, sums_);
    take_logarithm();
    for (int r = 0; r < p_; ++r) sums_.score.push_back(score_(r));
    for (int r = 0; r < p_; ++r)
      for (int c = 0; c < p_; ++c) sums_.information.push_back(information_(r, c));
    return std::move(sums_);
  }

 private:
  template <typename Filter>
  friend void walk(const InnovationRun&, const FilterOptions&, Filter&, InnovationSums&);

  // README, Eq. 7: the start is the truth sample itself, with its error.
  void begin_at(int k) {
    place_at(k);
    if (!options_.on_step) return;
    step_ = FilterStep{};
    step_.starts = true;
    step_.heading_before_rad = step_.heading_rad = state_.heading_rad;
    step_.arm = arm();
    report_step(k);
  }

  void pass_by(int k) { report_step(k); }

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
    const double times = variance_of(k), position2 = times * position2_;
    double heading2 = times * heading2_, tracked_heading;
    const bool heading_is_read = run_.truth_has_heading && truth.heading_rad;
    if (heading_is_read) {
      tracked_heading = *truth.heading_rad;
    } else {
      const bool is_given = begins_ != nullptr;
      const UnknownHeading unknown =
          is_given ? *std::exchange(begins_, nullptr) : heading_from_shape(run_, summed_, model_, k, last_);
      tracked_heading = unknown.guess_rad + m.heading_rad;
      heading2 = unknown.stderr_rad * unknown.stderr_rad;
      if (!is_given) sums_.log_determinant -= std::log(heading2);
    }
    state_.heading_rad = tracked_heading - m.heading_rad;
    facing_ = turn_of(state_.heading_rad);
    const Vec2 arm = this->arm();
    state_.x_m = truth.position.x_m - arm.x_m;
    state_.y_m = truth.position.y_m - arm.y_m;
    covariance_ = {position2, 0.0, 0.0, position2, 0.0, heading2};
    covariance_ = covariance_.carried(-arm.x_m, -arm.y_m);  // back from the point to the axle
    covariance_.add(count_error_.times(times).turned(facing_.c, facing_.s));
    if (slopes_) slopes_->begin_at(position2, heading_is_read ? heading2 : 0.0, arm);
    if constexpr (columns != kNoColumns) {
      derivative_.setZero();
      const double c = facing_.c, s = facing_.s;
      derivative_.col(column::mounting_x) << -c, -s, 0.0;
      derivative_.col(column::mounting_y) << s, -c, 0.0;
      if (run_.truth_has_heading) derivative_.col(column::mounting_heading) << -arm.y_m, arm.x_m, -1.0;
    }
  }

  void predict(int t) {
    const RelativeMotion& step = summed_.motions[t];
    const double c = facing_.c, s = facing_.s;
    const double dx = c * step.motion.x_m - s * step.motion.y_m, dy = s * step.motion.x_m + c * step.motion.y_m;
    if constexpr (columns != kNoColumns) {
      constexpr int kGiven = columns == kUsualColumns ? column::first_extra : columns;
      const Eigen::Map<const Eigen::Matrix<double, 3, kGiven>> jac(
          &summed_.derivatives[3 * static_cast<std::size_t>(p_) * t], 3, p_);
      auto x = derivative_.row(0).template head<kGiven>(p_), y = derivative_.row(1).template head<kGiven>(p_),
           heading = derivative_.row(2).template head<kGiven>(p_);
      x += -dy * heading + c * jac.row(0) - s * jac.row(1);
      y += dx * heading + s * jac.row(0) + c * jac.row(1);
      heading += jac.row(2);
    }
    PoseCovariance noise = PoseCovariance::packed(step.count_noise);
    const PoseCovariance of_wheels = PoseCovariance::packed(step.wheel_noise).times(wheel2_),
                         along = PoseCovariance::packed(step.along_noise).times(along2_),
                         turning = PoseCovariance::packed(step.turning_noise).times(turning2_),
                         sideways = PoseCovariance::packed(step.sideways_noise).times(sideways2_),
                         timing = PoseCovariance::packed(step.timing_noise).times(timing2_);
    noise.add(of_wheels);
    noise.add(along);
    noise.add(turning);
    noise.add(sideways);
    noise.add(timing);
    const double took_s = run_.truth[t + 1].time_s - run_.truth[t].time_s;
    const double wandered2 = wander2_ * took_s, turned2 = heading_wander2_ * took_s;
    if (slopes_) {
      slopes_->carry(dx, dy);
      slopes_->grow(noise_size::wander, {wandered2, 0.0, 0.0, wandered2, 0.0, 0.0});
      slopes_->grow(noise_size::heading_wander, {0.0, 0.0, 0.0, 0.0, 0.0, turned2});
      slopes_->grow(noise_size::wheel, of_wheels.turned(c, s));
      slopes_->grow(noise_size::along, along.turned(c, s));
      slopes_->grow(noise_size::turning, turning.turned(c, s));
      slopes_->grow(noise_size::sideways, sideways.turned(c, s));
      slopes_->grow(noise_size::command_timing, timing.turned(c, s));
    }
    covariance_ = covariance_.carried(dx, dy);
    covariance_.add(noise.turned(c, s));
    covariance_.xx += wandered2;
    covariance_.yy += wandered2;
    covariance_.hh += turned2;
    if (options_.on_step) {
      step_.moved = {dx, dy};
      step_.heading_before_rad = state_.heading_rad;
    }
    state_.x_m += dx;
    state_.y_m += dy;
    turn(step.motion.heading_rad);
    step_.heading_rad = state_.heading_rad;
  }

  void turn(double by_rad) {
    constexpr int kOften = 256;  // turned on and on, cosine and sine would drift away in the end
    state_.heading_rad += by_rad;
    facing_ = ++turns_ % kOften == 0 ? turn_of(state_.heading_rad) : facing_.then(turn_of(by_rad));
  }
  double variance_of(int k) const {
    return run_.truth_variance.empty() ? 1.0 : run_.truth_variance[static_cast<std::size_t>(k)];
  }
  Vec2 arm() const {  // from the axle to the tracked point, in the room
    const Pose& m = model_.truth.axle_T_tracked;
    return {facing_.c * m.x_m - facing_.s * m.y_m, facing_.s * m.x_m + facing_.c * m.y_m};
  }

  void take_logarithm() {
    sums_.log_determinant += std::log(determinant_);
    determinant_ = 1.0;
  }

  // README, Eqs. 8 and 9. False where the gate refuses the sample.
  bool update(int k) {
    const TruthSample& truth = run_.truth[k];
    const Pose& m = model_.truth.axle_T_tracked;
    const Vec2 arm = this->arm();
    const int n = truth.heading_rad && run_.truth_has_heading ? 3 : 2;
    const double residual[3] = {truth.position.x_m - state_.x_m - arm.x_m, truth.position.y_m - state_.y_m - arm.y_m,
                                n == 3 ? soon_wrapped(*truth.heading_rad - state_.heading_rad - m.heading_rad) : 0.0};
    const double times = variance_of(k), position2 = times * position2_, heading2 = times * heading2_;
    PoseCovariance s = covariance_;
    s.add(count_error_.times(times).turned(facing_.c, facing_.s));
    s = s.carried(arm.x_m, arm.y_m);
    s.xx += position2;
    s.yy += position2;
    s.hh += heading2;
    if (n == 2) {  // a heading that was not read: infinitely uncertain, and no residual
      s.xh = s.yh = 0.0;
      s.hh = 1.0;
    }
    // S = l d l' by hand, l lower with ones on its diagonal, d diagonal; i: one over d.
    const double i0 = 1.0 / s.xx, l10 = s.xy * i0, l20 = s.xh * i0;
    const double d1 = std::max(s.yy - l10 * s.xy, 1e-300), i1 = 1.0 / d1, under = s.yh - l20 * s.xy, l21 = under * i1;
    const double d2 = std::max(s.hh - l20 * s.xh - l21 * under, 1e-300), i2 = 1.0 / d2;
    const auto decorrelate = [&](double* v) {  // by l^-1
      v[1] -= l10 * v[0];
      v[2] -= l20 * v[0] + l21 * v[1];
    };
    double left[3] = {residual[0], residual[1], residual[2]};
    decorrelate(left);
    const double weighed[3] = {i0 * left[0], i1 * left[1], i2 * left[2]};
    const double squared = left[0] * weighed[0] + left[1] * weighed[1] + left[2] * weighed[2];
    const auto whiten = [&](const double* v, double* white) {  // as by the Cholesky factor
      white[0] = std::sqrt(i0) * v[0];
      white[1] = std::sqrt(i1) * v[1];
      white[2] = std::sqrt(i2) * v[2];
    };
    const bool refused = options_.gate > 0.0 && squared > (n == 3 ? options_.gate : 0.9 * options_.gate);
    if (options_.on_innovation) {
      double white[3];
      whiten(left, white);
      options_.on_innovation(innovation_of(truth.time_s, k, n, residual, white, s, squared, refused));
    }
    if (refused) {
      sums_.set_aside[k] = 1;
      report_step(k);
      return false;
    }
    sums_.chi2 += squared;
    determinant_ *= s.xx * d1 * (n == 3 ? d2 : 1.0);
    if (determinant_ < kSmall || determinant_ > kLarge) take_logarithm();
    sums_.scalars += n;

    // The gain acts on the error of the pose alone, not on the rounding of this very reading of the encoders: that part
    // of S is uncorrelated with the pose before and after.
    double by[3][3], gain[3][3];  // by[j]: l^-1 H P of column j; gain[j] the same over d, so that K = gain l^-1
    const double p[3][3] = {{covariance_.xx, covariance_.xy, covariance_.xh},
                            {covariance_.xy, covariance_.yy, covariance_.yh},
                            {covariance_.xh, covariance_.yh, covariance_.hh}};
    for (int j = 0; j < 3; ++j) {
      by[j][0] = p[0][j] - arm.y_m * p[2][j];
      by[j][1] = p[1][j] + arm.x_m * p[2][j];
      by[j][2] = n == 2 ? 0.0 : p[2][j];
      decorrelate(by[j]);
      gain[j][0] = i0 * by[j][0], gain[j][1] = i1 * by[j][1], gain[j][2] = i2 * by[j][2];
    }
    if (slopes_) {  // which know the Cholesky factor
      double of_columns[3][3], white[3];
      for (int j = 0; j < 3; ++j) whiten(by[j], of_columns[j]);
      whiten(left, white);
      const double r0 = std::sqrt(s.xx), r1 = std::sqrt(d1);
      slopes_->update({l10 * r0, l20 * r0, l21 * r1, std::sqrt(i0), std::sqrt(i1), n == 3 ? std::sqrt(i2) : 0.0,
                       of_columns, white, arm, n == 3},
                      position2, heading2);
    }
    const auto product = [](const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    covariance_.xx -= product(by[0], gain[0]);
    covariance_.xy -= product(by[0], gain[1]);
    covariance_.xh -= product(by[0], gain[2]);
    covariance_.yy -= product(by[1], gain[1]);
    covariance_.yh -= product(by[1], gain[2]);
    covariance_.hh -= product(by[2], gain[2]);

    if constexpr (columns != kNoColumns) {
      auto x = jacobian_.row(0), y = jacobian_.row(1), heading = jacobian_.row(2);
      x = derivative_.row(0) - arm.y_m * derivative_.row(2);
      y = derivative_.row(1) + arm.x_m * derivative_.row(2);
      if (n == 3)
        heading = derivative_.row(2);
      else
        heading.setZero();
      x(column::mounting_x) += facing_.c;
      y(column::mounting_x) += facing_.s;
      x(column::mounting_y) -= facing_.s;
      y(column::mounting_y) += facing_.c;
      if (n == 3) heading(column::mounting_heading) += 1.0;
      y -= l10 * x;
      heading -= l20 * x + l21 * y;
      for (Eigen::Index r = 0; r < information_.rows(); ++r) {
        const double a0 = i0 * x(r), a1 = i1 * y(r), a2 = i2 * heading(r);
        information_.row(r) += a0 * x + a1 * y + a2 * heading;
      }
      score_ += weighed[0] * x + weighed[1] * y + weighed[2] * heading;
      if (options_.batch > 0) {
        const std::size_t number = static_cast<std::size_t>(k / options_.batch);
        if (sums_.batch_scores.size() <= number) sums_.batch_scores.resize(number + 1, std::vector<double>(p_, 0.0));
        for (int r = 0; r < p_; ++r)
          sums_.batch_scores[number][r] += weighed[0] * x(r) + weighed[1] * y(r) + weighed[2] * heading(r);
      }
      for (int r = 0; r < 3; ++r) derivative_.row(r) -= gain[r][0] * x + gain[r][1] * y + gain[r][2] * heading;
    }
    state_.x_m += product(gain[0], left);
    state_.y_m += product(gain[1], left);
    turn(product(gain[2], left));
    if (options_.on_step) {
      step_.used = true;
      step_.size = n;
      step_.arm = arm;
      for (int j = 0; j < 3; ++j) step_.residual[j] = residual[j];
      s.pack(step_.covariance);
      // K, column by column from the last.
      for (int r = 0; r < 3; ++r) {
        const double g2 = gain[r][2];
        const double g1 = gain[r][1] - g2 * l21;
        const double g0 = gain[r][0] - g1 * l10 - g2 * l20;
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
  NoiseCarry* slopes_;            // null where nobody asks for them
  const UnknownHeading* begins_;  // the first start's; null where the shape of the path finds it
  int p_;
  int last_;
  Pose state_;
  Turn facing_;  // cosine and sine of its heading
  int turns_ = 0;
  PoseCovariance covariance_, count_error_;
  double position2_, heading2_, wheel2_, along2_, turning2_, sideways2_;  // variances, as these
  double wander2_, heading_wander2_, timing2_;
  double determinant_ = 1.0;  // of the samples since the last logarithm
  Eigen::Matrix<double, 3, columns, Eigen::RowMajor> derivative_, jacobian_;
  Eigen::Matrix<double, columns, columns, Eigen::RowMajor> information_;
  Eigen::Matrix<double, 1, columns> score_;
  InnovationSums sums_;
  FilterStep step_;
};

}  // namespace odolab
