#include "core/calibration/innovations.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/calibration/noise_carry.h"
#include "core/calibration/pose_covariance.h"

namespace odolab {

namespace {

// A Cholesky factor's product is that far from what a double cannot hold before its logarithm is taken.
constexpr double kSmall = 1e-100, kLarge = 1e100;

// The same as `wrapped`, sooner where there is nothing to do.
double soon_wrapped(double angle_rad) { return std::abs(angle_rad) < kPi ? angle_rad : wrapped(angle_rad); }

struct UnknownHeading {
  double guess_rad = 0.0, stderr_rad = 1.0;
};

// The heading that lays the first metres of dead reckoning onto a truth without headings. Its error is taken ten times
// as large as the truth's noise makes it, since the filter uses the same samples again, and between a tenth of a radian
// and one. Not wider than need be: at rest a filter that knows nothing of the heading turns it about the tracked point
// with every sample, each time as if it had learned something.
UnknownHeading heading_from_shape(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                                  int first, int last) {
  constexpr double kTimes = 10.0, kLeast_rad = 0.1;
  double cosine = 0.0, sine = 0.0, travelled = 0.0, square_m2 = 0.0;
  int samples = 0;
  Pose pose;
  const Vec2 m = model.truth.axle_T_tracked.position(), start = pose * m;
  for (int t = first; t + 1 < last && !is_cut(run, t + 1); ++t) {
    pose = pose * summed.motions[t].motion;
    travelled += length(summed.motions[t].motion.position());
    if (run.set_aside[t + 1]) continue;
    const Vec2 guess = pose * m - start, truth = run.truth[t + 1].position - run.truth[first].position;
    cosine += dot(guess, truth);
    sine += cross(guess, truth);
    square_m2 += dot(guess, guess);
    ++samples;
    if (travelled > 2.0 && std::hypot(cosine, sine) > 0.5) break;
  }
  UnknownHeading heading{std::atan2(sine, cosine), 1.0};
  if (square_m2 > 0.0)
    heading.stderr_rad =
        std::clamp(kTimes * model.noise.truth_position_m / std::sqrt(square_m2 / samples), kLeast_rad, 1.0);
  return heading;
}

class PoseFilter {
 public:
  PoseFilter(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
             const FilterOptions& options, NoiseCarry* slopes = nullptr)
      : run_(run),
        summed_(summed),
        model_(model),
        options_(options),
        slopes_(slopes),
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
    count_error_.xx = 0.25 * (left + right);
    count_error_.xh = 0.5 * (right - left) / b;
    count_error_.hh = (left + right) / (b * b);
    position2_ = model.noise.truth_position_m * model.noise.truth_position_m;
    heading2_ = model.noise.truth_heading_rad * model.noise.truth_heading_rad;
    wheel2_ = model.noise.wheel_m_per_sqrt_m * model.noise.wheel_m_per_sqrt_m;
    body2_ = model.noise.body_m_per_sqrt_m * model.noise.body_m_per_sqrt_m;
    sideways2_ = model.noise.sideways_m_per_sqrt_m * model.noise.sideways_m_per_sqrt_m;
  }

  InnovationSums run() {
    sums_.set_aside = options_.gate > 0.0 ? std::vector<char>(run_.truth.size(), 0) : run_.set_aside;
    int start = options_.first;
    if (options_.gate <= 0.0)
      while (start + 1 < last_ && run_.set_aside[start]) ++start;
    begin_at(start);
    int refused = 0;
    bool lost = false;  // behind a cut, until there is a sample to start from
    for (int t = start; t + 1 < last_; ++t) {
      const int k = t + 1;
      lost = lost || is_cut(run_, k);
      if (lost) {
        begin_at(k);
        refused = 0;
        lost = options_.gate <= 0.0 && run_.set_aside[k];
        continue;
      }
      predict(t);
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
    take_logarithm();
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
    step_.arm = arm();
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
    double heading2 = heading2_, tracked_heading;
    const bool heading_is_read = run_.truth_has_heading && truth.heading_rad;
    if (heading_is_read) {
      tracked_heading = *truth.heading_rad;
    } else {
      const UnknownHeading unknown = heading_from_shape(run_, summed_, model_, k, last_);
      tracked_heading = unknown.guess_rad + m.heading_rad;
      heading2 = unknown.stderr_rad * unknown.stderr_rad;
    }
    state_.heading_rad = tracked_heading - m.heading_rad;
    face();
    const Vec2 arm = this->arm();
    state_.x_m = truth.position.x_m - arm.x_m;
    state_.y_m = truth.position.y_m - arm.y_m;
    covariance_ = {position2_, 0.0, 0.0, position2_, 0.0, heading2};
    covariance_ = covariance_.carried(-arm.x_m, -arm.y_m);  // back from the point to the axle
    covariance_.add(count_error_.turned(cos_, sin_));
    if (slopes_) slopes_->begin_at(position2_, heading_is_read ? heading2_ : 0.0, arm);
    if (p_ == 0) return;
    derivative_.setZero();
    const double c = cos_, s = sin_;
    derivative_.col(column::mounting_x) << -c, -s, 0.0;
    derivative_.col(column::mounting_y) << s, -c, 0.0;
    if (run_.truth_has_heading) derivative_.col(column::mounting_heading) << -arm.y_m, arm.x_m, -1.0;
  }

  void predict(int t) {
    const RelativeMotion& step = summed_.motions[t];
    const double c = cos_, s = sin_;
    const double dx = c * step.motion.x_m - s * step.motion.y_m, dy = s * step.motion.x_m + c * step.motion.y_m;
    const double* jac = p_ > 0 ? &summed_.derivatives[3 * static_cast<std::size_t>(p_) * t] : nullptr;
    for (int k = 0; k < p_; ++k, jac += 3) {
      double* d = &derivative_(0, k);
      d[0] += -dy * d[2] + c * jac[0] - s * jac[1];
      d[1] += dx * d[2] + s * jac[0] + c * jac[1];
      d[2] += jac[2];
    }
    PoseCovariance noise = PoseCovariance::packed(step.count_noise);
    const PoseCovariance of_wheels = PoseCovariance::packed(step.wheel_noise).times(wheel2_),
                         of_body = PoseCovariance::packed(step.body_noise).times(body2_),
                         of_sideways = PoseCovariance::packed(step.sideways_noise).times(sideways2_);
    noise.add(of_wheels);
    noise.add(of_body);
    noise.add(of_sideways);
    if (slopes_) {
      slopes_->carry(dx, dy);
      slopes_->grow(noise_size::wheel, of_wheels.turned(c, s));
      slopes_->grow(noise_size::body, of_body.turned(c, s));
      slopes_->grow(noise_size::sideways, of_sideways.turned(c, s));
    }
    covariance_ = covariance_.carried(dx, dy);
    covariance_.add(noise.turned(c, s));
    if (options_.on_step) {
      step_.moved = {dx, dy};
      step_.heading_before_rad = state_.heading_rad;
    }
    state_ = {state_.x_m + dx, state_.y_m + dy, state_.heading_rad + step.motion.heading_rad};
    face();
    step_.heading_rad = state_.heading_rad;
  }

  // Cosine and sine of the heading, for all that asks.
  void face() {
    cos_ = std::cos(state_.heading_rad);
    sin_ = std::sin(state_.heading_rad);
  }
  Vec2 arm() const {  // from the axle to the tracked point, in the room
    const Pose& m = model_.truth.axle_T_tracked;
    return {cos_ * m.x_m - sin_ * m.y_m, sin_ * m.x_m + cos_ * m.y_m};
  }

  void take_logarithm() {
    sums_.log_determinant += 2.0 * std::log(root_determinant_);
    root_determinant_ = 1.0;
  }

  // README, Eqs. 8 and 9. False where the gate refuses the sample.
  bool update(int k) {
    const TruthSample& truth = run_.truth[k];
    const Pose& m = model_.truth.axle_T_tracked;
    const Vec2 arm = this->arm();
    const int n = truth.heading_rad && run_.truth_has_heading ? 3 : 2;
    const double residual[3] = {truth.position.x_m - state_.x_m - arm.x_m, truth.position.y_m - state_.y_m - arm.y_m,
                                n == 3 ? soon_wrapped(*truth.heading_rad - state_.heading_rad - m.heading_rad) : 0.0};
    PoseCovariance s = covariance_;
    s.add(count_error_.turned(cos_, sin_));
    s = s.carried(arm.x_m, arm.y_m);
    s.xx += position2_;
    s.yy += position2_;
    s.hh += heading2_;
    if (n == 2) {  // a heading that was not read: infinitely uncertain, and no residual
      s.xh = s.yh = 0.0;
      s.hh = 1.0;
    }
    // Cholesky factor of S by hand: lower l, S = l l'.
    const double l00 = std::sqrt(s.xx), l10 = s.xy / l00, l20 = s.xh / l00;
    const double l11 = std::sqrt(std::max(s.yy - l10 * l10, 1e-300)), l21 = (s.yh - l20 * l10) / l11;
    const double l22 = std::sqrt(std::max(s.hh - l20 * l20 - l21 * l21, 1e-300));
    const auto whiten = [&](double* v) {
      v[0] /= l00;
      v[1] = (v[1] - l10 * v[0]) / l11;
      v[2] = (v[2] - l20 * v[0] - l21 * v[1]) / l22;
    };
    double white[3] = {residual[0], residual[1], residual[2]};
    whiten(white);
    const double squared = white[0] * white[0] + white[1] * white[1] + white[2] * white[2];
    const bool refused = options_.gate > 0.0 && squared > (n == 3 ? options_.gate : 0.9 * options_.gate);
    if (options_.on_innovation) {
      Innovation out;
      out.time_s = truth.time_s;
      out.truth_index = k;
      out.size = n;
      for (int j = 0; j < 3; ++j) {
        out.residual[j] = residual[j];
        out.white[j] = white[j];
      }
      s.pack(out.covariance);
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
    root_determinant_ *= l00 * l11 * (n == 3 ? l22 : 1.0);
    if (root_determinant_ < kSmall || root_determinant_ > kLarge) take_logarithm();
    sums_.scalars += n;

    // The gain acts on the error of the pose alone, not on the rounding of this very reading of the encoders: that part
    // of S is uncorrelated with the pose before and after.
    double by[3][3];  // by[j]: l^-1 H P of column j, so that K = by l^-1
    const double p[3][3] = {{covariance_.xx, covariance_.xy, covariance_.xh},
                            {covariance_.xy, covariance_.yy, covariance_.yh},
                            {covariance_.xh, covariance_.yh, covariance_.hh}};
    for (int j = 0; j < 3; ++j) {
      by[j][0] = p[0][j] - arm.y_m * p[2][j];
      by[j][1] = p[1][j] + arm.x_m * p[2][j];
      by[j][2] = n == 2 ? 0.0 : p[2][j];
      whiten(by[j]);
    }
    if (slopes_) {
      const double third = n == 3 ? 1.0 / l22 : 0.0;
      slopes_->update({l10, l20, l21, 1.0 / l00, 1.0 / l11, third, by, white, arm, n == 3}, position2_, heading2_);
    }
    const auto product = [](const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    covariance_.xx -= product(by[0], by[0]);
    covariance_.xy -= product(by[0], by[1]);
    covariance_.xh -= product(by[0], by[2]);
    covariance_.yy -= product(by[1], by[1]);
    covariance_.yh -= product(by[1], by[2]);
    covariance_.hh -= product(by[2], by[2]);

    if (p_ > 0) {
      const double c = cos_, sn = sin_;
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
        score_(r) += a0 * white[0] + a1 * white[1] + a2 * white[2];
      }
      if (options_.batch > 0) {
        const std::size_t number = static_cast<std::size_t>(k / options_.batch);
        if (sums_.batch_scores.size() <= number) sums_.batch_scores.resize(number + 1, std::vector<double>(p_, 0.0));
        for (int r = 0; r < p_; ++r)
          sums_.batch_scores[number][r] +=
              jacobian_(0, r) * white[0] + jacobian_(1, r) * white[1] + jacobian_(2, r) * white[2];
      }
      for (int j = 0; j < p_; ++j)
        for (int r = 0; r < 3; ++r) derivative_(r, j) -= product(by[r], &jacobian_(0, j));
    }
    state_ = {state_.x_m + product(by[0], white), state_.y_m + product(by[1], white),
              state_.heading_rad + product(by[2], white)};
    face();
    if (options_.on_step) {
      step_.used = true;
      step_.size = n;
      step_.arm = arm;
      for (int j = 0; j < 3; ++j) step_.residual[j] = residual[j];
      s.pack(step_.covariance);
      // K, column by column from the last.
      for (int r = 0; r < 3; ++r) {
        const double g2 = by[r][2] / l22;
        const double g1 = (by[r][1] - g2 * l21) / l11;
        const double g0 = (by[r][0] - g1 * l10 - g2 * l20) / l00;
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
  NoiseCarry* slopes_;  // null where nobody asks for them
  int p_;
  int last_;
  Pose state_;
  double cos_ = 1.0, sin_ = 0.0;  // of its heading
  PoseCovariance covariance_, count_error_;
  double position2_, heading2_, wheel2_, body2_, sideways2_;  // variances
  double root_determinant_ = 1.0;                             // of the samples since the last logarithm
  Eigen::Matrix<double, 3, Eigen::Dynamic> derivative_, jacobian_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd score_;
  InnovationSums sums_;
  FilterStep step_;
};

}  // namespace

FittedNoise as_large_as_any_real(FittedNoise noise) {
  constexpr double kLeast = 2e-5;
  noise.wheel_m_per_sqrt_m = std::max(noise.wheel_m_per_sqrt_m, kLeast);
  noise.truth_position_m = std::max(noise.truth_position_m, kLeast);
  noise.truth_heading_rad = std::max(noise.truth_heading_rad, kLeast);
  return noise;
}

InnovationSums filtered(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                        const FilterOptions& options) {
  return PoseFilter(run, summed, model, options).run();
}

NoiseSlopes noise_slopes(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model, int first,
                         int last) {
  FilterOptions options;
  options.derivatives = false;
  options.first = first;
  options.last = last;
  NoiseCarry carried;
  const InnovationSums sums = PoseFilter(run, summed, model, options, &carried).run();
  NoiseSlopes out;
  out.value = sums.chi2 + sums.log_determinant;
  out.scalars = sums.scalars;
  for (int k = 0; k < noise_size::count; ++k) {
    out.slope[k] = carried.slope(k);
    for (int j = 0; j < noise_size::count; ++j) out.curvature[noise_size::count * k + j] = carried.curvature(k, j);
  }
  return out;
}

}  // namespace odolab
