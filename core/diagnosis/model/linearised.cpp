#include "core/diagnosis/model/linearised.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/model/off_truth.h"

namespace odolab {

namespace {

// Lower Cholesky factor's inverse of a symmetric 3 by 3 matrix, times the rotation into the vehicle's frame.
void whitener_of(const FilterStep& step, const Turn& here, double* out) {
  const double c = here.c, s = here.s;
  const double* m = step.covariance;
  // R' S R with R the rotation by the heading: rows along, across, heading.
  const double xx = c * c * m[0] + 2.0 * c * s * m[1] + s * s * m[3];
  const double xy = -c * s * m[0] + (c * c - s * s) * m[1] + c * s * m[3];
  const double yy = s * s * m[0] - 2.0 * c * s * m[1] + c * c * m[3];
  const double xh = step.size == 3 ? c * m[2] + s * m[4] : 0.0, yh = step.size == 3 ? -s * m[2] + c * m[4] : 0.0;
  const double hh = step.size == 3 ? m[5] : 1.0;
  const double l00 = std::sqrt(xx), l10 = xy / l00, l20 = xh / l00;
  const double l11 = std::sqrt(std::max(yy - l10 * l10, 1e-300)), l21 = (yh - l20 * l10) / l11;
  const double l22 = std::sqrt(std::max(hh - l20 * l20 - l21 * l21, 1e-300));
  const double i00 = 1.0 / l00, i11 = 1.0 / l11, i22 = step.size == 3 ? 1.0 / l22 : 0.0;
  const double i10 = -l10 * i00 * i11, i21 = -l21 * i11 * i22, i20 = (l10 * l21 - l11 * l20) * i00 * i11 * i22;
  const double w[9] = {i00 * c,           i00 * s,           0.0,  // times R'
                       i10 * c - i11 * s, i10 * s + i11 * c, 0.0, i20 * c - i21 * s, i20 * s + i21 * c, i22};
  for (int k = 0; k < 9; ++k) out[k] = w[k];
}

}  // namespace

LinearisedRun::LinearisedRun(InnovationRun given, const InnovationModel& model, bool with_columns)
    : run_(std::make_shared<const InnovationRun>(std::move(given))), model_(model) {
  const InnovationRun& run = *run_;
  summed_ = summed_up(run, model);
  const int n = static_cast<int>(run.truth.size());
  steps_.resize(n);
  for (int k = 0; k < n; ++k) steps_[k].truth_index = -1;
  FilterOptions options;
  options.derivatives = false;
  options.on_step = [&](const FilterStep& step) { steps_[step.truth_index] = step; };
  sums_ = filtered(run, summed_, model, options);
  whitener_.assign(9 * static_cast<std::size_t>(n), 0.0);
  residual_.assign(3 * static_cast<std::size_t>(n), 0.0);
  here_.resize(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    here_[static_cast<std::size_t>(k)] = turn_of(steps_[k].heading_rad);
    if (!steps_[k].used) continue;
    double* w = &whitener_[9 * static_cast<std::size_t>(k)];
    whitener_of(steps_[k], here_[static_cast<std::size_t>(k)], w);
    for (int r = 0; r < 3; ++r)
      residual_[3 * k + r] = (w[3 * r] * steps_[k].residual[0] + w[3 * r + 1] * steps_[k].residual[1] +
                              w[3 * r + 2] * steps_[k].residual[2]);
  }
  if (!with_columns) return;
  prepare_carry();
  cut_into_pieces();
}

void LinearisedRun::prepare_carry() {
  const int n = samples();
  carry_.resize(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const FilterStep& step = steps_[k];
    Carry& carry = carry_[static_cast<std::size_t>(k)];
    if (step.truth_index < 0 || step.starts) continue;
    const Turn before = here_[static_cast<std::size_t>(k)].then(turn_of(step.heading_before_rad - step.heading_rad));
    carry.c = before.c;
    carry.s = before.s;
    carry.dx = step.moved.x_m;
    carry.dy = step.moved.y_m;
    carry.on[0] = carry.on[4] = carry.on[8] = 1.0;
    if (!step.used) continue;
    const double ax = step.arm.x_m, ay = step.arm.y_m;
    const double* w = &whitener_[9 * static_cast<std::size_t>(k)];
    for (int r = 0; r < 3; ++r) {
      const double g2 = step.size == 2 ? 0.0 : step.gain[3 * r + 2], w2 = step.size == 2 ? 0.0 : w[3 * r + 2];
      carry.out[3 * r] = w[3 * r];
      carry.out[3 * r + 1] = w[3 * r + 1];
      carry.out[3 * r + 2] = -ay * w[3 * r] + ax * w[3 * r + 1] + w2;
      carry.on[3 * r] -= step.gain[3 * r];
      carry.on[3 * r + 1] -= step.gain[3 * r + 1];
      carry.on[3 * r + 2] -= -ay * step.gain[3 * r] + ax * step.gain[3 * r + 1] + g2;
    }
  }
  if (model_.noise.wander_lasts_s <= 0.0) return;
  truth_carry_.resize(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const FilterStep& step = steps_[k];
    TruthCarry& carry = truth_carry_[static_cast<std::size_t>(k)];
    if (step.truth_index < 0 || step.starts) continue;
    carry.decay = step.truth_decay;
    if (!step.used) continue;
    carry.ax = step.arm.x_m;
    carry.ay = step.arm.y_m;
    carry.read_heading = step.size == 3 ? 1.0 : 0.0;
    std::copy_n(&whitener_[9 * static_cast<std::size_t>(k)], 9, carry.out);
    std::copy_n(step.gain, 9, carry.pose_gain);
    std::copy_n(step.truth_gain, 9, carry.truth_gain);
  }
}

namespace {

using Square6 = Eigen::Matrix<double, 6, 6>;
using Rows3 = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

}  // namespace

LinearisedRun::Tails LinearisedRun::tails() const {
  const int n = samples();
  Tails tails;
  if (truth_comes_back()) {
    tails.of_both.assign(static_cast<std::size_t>(n), Square6::Zero());
    for (int k = n - 1; k > 0; --k) {
      const Carry& carry = carry_[static_cast<std::size_t>(k)];
      const TruthCarry& truth = truth_carry_[static_cast<std::size_t>(k)];
      Eigen::Matrix3d reads = Eigen::Matrix3d::Identity();
      reads(0, 2) = -truth.ay, reads(1, 2) = truth.ax, reads(2, 2) = truth.read_heading;
      Eigen::Matrix3d reads_off = Eigen::Matrix3d::Identity();
      reads_off(2, 2) = truth.read_heading;
      Eigen::Matrix<double, 3, 6> out;
      out << Rows3(carry.out), Rows3(truth.out);
      Square6 on;
      on << Rows3(carry.on), -Rows3(truth.pose_gain) * reads_off, -Rows3(truth.truth_gain) * reads,
          Eigen::Matrix3d::Identity() - Rows3(truth.truth_gain) * reads_off;
      Square6 moved = Square6::Identity();
      moved(0, 2) = -carry.dy, moved(1, 2) = carry.dx;
      moved.bottomRightCorner<3, 3>() *= truth.decay;
      const Square6 of_e = out.transpose() * out + on.transpose() * tails.of_both[static_cast<std::size_t>(k)] * on;
      tails.of_both[static_cast<std::size_t>(k) - 1] = moved.transpose() * of_e * moved;
    }
    return tails;
  }
  tails.of_pose.assign(static_cast<std::size_t>(n), {0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  for (int k = n - 1; k > 0; --k) {
    const Carry& carry = carry_[static_cast<std::size_t>(k)];
    const std::array<double, 6>& s = tails.of_pose[static_cast<std::size_t>(k)];
    const double behind[9] = {s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5]};
    // of e: out' out + on' behind on
    double by[9], of_e[9];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        by[3 * r + c] =
            behind[3 * r] * carry.on[c] + behind[3 * r + 1] * carry.on[3 + c] + behind[3 * r + 2] * carry.on[6 + c];
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c)
        of_e[3 * r + c] = carry.out[r] * carry.out[c] + carry.out[3 + r] * carry.out[3 + c] +
                          carry.out[6 + r] * carry.out[6 + c] + carry.on[r] * by[c] + carry.on[3 + r] * by[3 + c] +
                          carry.on[6 + r] * by[6 + c];
    // of d: e = F d turns the heading's column into -dy x + dx y + h
    const double xh = -carry.dy * of_e[0] + carry.dx * of_e[1] + of_e[2];
    const double yh = -carry.dy * of_e[1] + carry.dx * of_e[4] + of_e[5];
    const double eh = -carry.dy * of_e[2] + carry.dx * of_e[5] + of_e[8];
    tails.of_pose[static_cast<std::size_t>(k) - 1] = {of_e[0], of_e[1], xh,
                                                      of_e[4], yh,      -carry.dy * xh + carry.dx * yh + eh};
  }
  return tails;
}

namespace {

// The steps in which something moves, within those that the motions hold.
std::pair<std::size_t, std::size_t> moving(const Motions& motions) {
  const auto moves = [&](std::size_t step) {
    const BodyMotion m = motions.at(step);
    return m.forward_m != 0.0 || m.sideways_m != 0.0 || m.turn_rad != 0.0;
  };
  std::size_t first = motions.first(), end = motions.end();
  while (first < end && !moves(first)) ++first;
  while (first < end && !moves(end - 1)) --end;
  return {first, end};
}

}  // namespace

Stretch LinearisedRun::of_motion(const Motions& motions, double* out) const {
  const auto [first_step, end_step] = moving(motions);
  if (first_step == end_step) return {0, 0};
  const Stretch with_motion = touched(first_step, end_step);
  const int first = with_motion.first, n = samples();
  if (first >= n - 1) return {0, 0};
  double d0 = 0.0, d1 = 0.0, d2 = 0.0, largest = 0.0;
  OffTruth<double> off;
  out[3 * first] = out[3 * first + 1] = out[3 * first + 2] = 0.0;
  for (int t = first; t + 1 < n; ++t) {
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    double e0 = d0 - carry.dy * d2, e1 = d1 + carry.dx * d2, e2 = d2;
    if (t < with_motion.last) {
      for (int p = first_piece_[t]; p < first_piece_[t + 1]; ++p) {
        const Piece& piece = pieces_[p];
        const BodyMotion m = motions.at(static_cast<std::size_t>(piece.interval));
        e0 += piece.forward_x * m.forward_m - piece.forward_y * m.sideways_m + piece.turn_x * m.turn_rad;
        e1 += piece.forward_y * m.forward_m + piece.forward_x * m.sideways_m + piece.turn_y * m.turn_rad;
        e2 += piece.share * m.turn_rad;
      }
    }
    double* const o = out + 3 * (t + 1);
    for (int r = 0; r < 3; ++r) o[r] = carry.out[3 * r] * e0 + carry.out[3 * r + 1] * e1 + carry.out[3 * r + 2] * e2;
    d0 = carry.on[0] * e0 + carry.on[1] * e1 + carry.on[2] * e2;
    d1 = carry.on[3] * e0 + carry.on[4] * e1 + carry.on[5] * e2;
    d2 = carry.on[6] * e0 + carry.on[7] * e1 + carry.on[8] * e2;
    if (truth_comes_back()) off.go_on(truth_carry_[static_cast<std::size_t>(t) + 1], e0, e1, e2, o, d0, d1, d2);
    const double size = std::abs(o[0]) + std::abs(o[1]) + std::abs(o[2]);
    if (t < with_motion.last) {
      largest = std::max(largest, size);
    } else if (steps_[t + 1].used && size < 1e-6 * largest && t > with_motion.last + 5) {
      return {first, t + 2};  // behind a short event nothing is left after a while
    }
  }
  return {first, n};
}

void LinearisedRun::of_parameters(const std::array<double*, column::first_extra>& out) const {
  constexpr int kLanes = column::first_extra + 1;  // one stays empty
  using Lanes = Eigen::Array<double, kLanes, 1>;
  using Given = Eigen::Map<const Eigen::Matrix<double, 3, column::first_extra>>;
  const int n = samples();
  Lanes d[3] = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
  OffTruth<Lanes> off;
  const auto put = [&](int t, const Lanes* o) {
    for (int c = 0; c < column::first_extra; ++c)
      if (double* const to = out[static_cast<std::size_t>(c)])
        for (int r = 0; r < 3; ++r) to[3 * t + r] = o[r](c);
  };
  // By the mounting where the filter begins, from the sample itself.
  const auto start_at = [&](int k) {
    const FilterStep& step = steps_[k];
    const Turn& here = here_[static_cast<std::size_t>(k)];
    for (Lanes& row : d) row.setZero();
    off = {};
    d[0](column::mounting_x) = -here.c, d[1](column::mounting_x) = -here.s;
    d[0](column::mounting_y) = here.s, d[1](column::mounting_y) = -here.c;
    if (!run_->truth_has_heading) return;
    d[0](column::mounting_heading) = -step.arm.y_m;
    d[1](column::mounting_heading) = step.arm.x_m;
    d[2](column::mounting_heading) = -1.0;
  };
  if (steps_[0].starts) start_at(0);
  const Lanes nothing[3] = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
  put(0, nothing);
  for (int t = 0; t + 1 < n; ++t) {
    const FilterStep& step = steps_[t + 1];
    if (step.truth_index < 0 || step.starts) {  // before the filter's start, or where it starts anew
      put(t + 1, nothing);
      if (step.starts) start_at(t + 1);
      continue;
    }
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    const Given jac(&summed_.derivatives[3 * static_cast<std::size_t>(summed_.columns) * static_cast<std::size_t>(t)]);
    Lanes x = Lanes::Zero(), y = Lanes::Zero(), heading = Lanes::Zero();
    x.head<column::first_extra>() = jac.row(0).transpose().array();
    y.head<column::first_extra>() = jac.row(1).transpose().array();
    heading.head<column::first_extra>() = jac.row(2).transpose().array();
    const Lanes e0 = d[0] - carry.dy * d[2] + carry.c * x - carry.s * y;
    const Lanes e1 = d[1] + carry.dx * d[2] + carry.s * x + carry.c * y;
    const Lanes e2 = d[2] + heading;
    Lanes o[3];
    for (int r = 0; r < 3; ++r) {
      o[r] = carry.out[3 * r] * e0 + carry.out[3 * r + 1] * e1 + carry.out[3 * r + 2] * e2;
      d[r] = carry.on[3 * r] * e0 + carry.on[3 * r + 1] * e1 + carry.on[3 * r + 2] * e2;
    }
    if (truth_comes_back()) off.go_on(truth_carry_[static_cast<std::size_t>(t) + 1], e0, e1, e2, o, d[0], d[1], d[2]);
    if (step.used) {  // what is read moves with the mounting too
      const double* w = &whitener_[9 * static_cast<std::size_t>(t + 1)];
      const double c = here_[static_cast<std::size_t>(t) + 1].c, s = here_[static_cast<std::size_t>(t) + 1].s;
      for (int r = 0; r < 3; ++r) {
        const double *by = w + 3 * r, *gain = step.gain + 3 * r;
        o[r](column::mounting_x) += by[0] * c + by[1] * s;
        d[r](column::mounting_x) -= gain[0] * c + gain[1] * s;
        o[r](column::mounting_y) += by[1] * c - by[0] * s;
        d[r](column::mounting_y) -= gain[1] * c - gain[0] * s;
        if (step.size == 3) {
          o[r](column::mounting_heading) += by[2];
          d[r](column::mounting_heading) -= gain[2];
        }
        if (!truth_comes_back()) continue;
        const double* truth_gain = step.truth_gain + 3 * r;
        off.by[r](column::mounting_x) -= truth_gain[0] * c + truth_gain[1] * s;
        off.by[r](column::mounting_y) -= truth_gain[1] * c - truth_gain[0] * s;
        if (step.size == 3) off.by[r](column::mounting_heading) -= truth_gain[2];
      }
    }
    put(t + 1, o);
  }
}

void LinearisedRun::of_clock_rate(double* out) const {
  const int n = samples();
  double d0 = 0.0, d1 = 0.0, d2 = 0.0;
  OffTruth<double> off;
  out[0] = out[1] = out[2] = 0.0;
  for (int t = 0; t + 1 < n; ++t) {
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    double motion[3] = {0.0, 0.0, 0.0};
    if (first_piece_[t] < first_piece_[t + 1]) {
      // A clock that runs fast is an offset that grows: at both ends of a motion the body's velocity there, times the
      // time since the first sample. The clock's own derivative holds the difference of both; the end's part is split
      // off. The start's velocity also swings the motion about, which that derivative has in it already.
      const double t0 = run_->truth[t].time_s - run_->truth[0].time_s,
                   t1 = run_->truth[t + 1].time_s - run_->truth[0].time_s;
      const double* jac =
          &summed_.derivatives[3 * (static_cast<std::size_t>(summed_.columns) * t + column::truth_clock)];
      const double* end = &summed_.end_velocity[3 * static_cast<std::size_t>(t)];
      // offset(t) = -rate (t - t_0): jac = start velocity - end velocity
      for (int k = 0; k < 3; ++k) motion[k] = -(t0 * (jac[k] + end[k]) - t1 * end[k]);
    }
    const double e0 = d0 - carry.dy * d2 + carry.c * motion[0] - carry.s * motion[1],
                 e1 = d1 + carry.dx * d2 + carry.s * motion[0] + carry.c * motion[1], e2 = d2 + motion[2];
    double* const o = out + 3 * (t + 1);
    for (int r = 0; r < 3; ++r) o[r] = carry.out[3 * r] * e0 + carry.out[3 * r + 1] * e1 + carry.out[3 * r + 2] * e2;
    d0 = carry.on[0] * e0 + carry.on[1] * e1 + carry.on[2] * e2;
    d1 = carry.on[3] * e0 + carry.on[4] * e1 + carry.on[5] * e2;
    d2 = carry.on[6] * e0 + carry.on[7] * e1 + carry.on[8] * e2;
    if (truth_comes_back()) off.go_on(truth_carry_[static_cast<std::size_t>(t) + 1], e0, e1, e2, o, d0, d1, d2);
  }
}

}  // namespace odolab
