#include "core/diagnosis/linearised.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

// Lower Cholesky factor's inverse of a symmetric 3 by 3 matrix, times the rotation into the vehicle's frame.
void whitener_of(const FilterStep& step, double* out) {
  const double c = std::cos(step.heading_rad), s = std::sin(step.heading_rad);
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

LinearisedRun::LinearisedRun(InnovationRun given, const InnovationModel& model)
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
  turned_.resize(n);
  for (int k = 0; k < n; ++k) {
    const double before = steps_[k].heading_before_rad, here = steps_[k].heading_rad;
    turned_[k] = {std::cos(before), std::sin(before), std::cos(here), std::sin(here)};
    if (!steps_[k].used) continue;
    double* w = &whitener_[9 * static_cast<std::size_t>(k)];
    whitener_of(steps_[k], w);
    for (int r = 0; r < 3; ++r)
      residual_[3 * k + r] = (w[3 * r] * steps_[k].residual[0] + w[3 * r + 1] * steps_[k].residual[1] +
                              w[3 * r + 2] * steps_[k].residual[2]);
  }

  // The same pieces that summed_up walks through.
  const auto& wheels = run.wheels;
  const double b = model.drive.wheelbase_m;
  std::size_t i = 0;
  double now_s = run.truth[0].time_s - model.truth.time_offset_s;
  pieces_.reserve(wheels.size() + run.truth.size());
  for (int t = 0; t + 1 < n; ++t) {
    first_piece_.push_back(static_cast<int>(pieces_.size()));
    const double end_s = run.truth[t + 1].time_s - model.truth.time_offset_s;
    Pose pose;
    while (now_s < end_s) {
      while (i + 2 < wheels.size() && wheels[i + 1].time_s <= now_s) ++i;
      const double until_s = i + 2 >= wheels.size() ? end_s : std::min(end_s, wheels[i + 1].time_s);
      const double share = (until_s - now_s) / (wheels[i + 1].time_s - wheels[i].time_s);
      const double left_m = model.drive.wheel_radius_left_m * share * (wheels[i + 1].left_rad - wheels[i].left_rad);
      const double right_m = model.drive.wheel_radius_right_m * share * (wheels[i + 1].right_rad - wheels[i].right_rad);
      double forward = 0.5 * (left_m + right_m), sideways = 0.0, turn = (right_m - left_m) / b;
      for (const ExtraColumn& e : run.extra) {
        forward += share * e.value * e.per_step[i].forward_m;
        sideways += share * e.value * e.per_step[i].sideways_m;
        turn += share * e.value * e.per_step[i].turn_rad;
      }
      const double middle = pose.heading_rad + 0.5 * turn, c = std::cos(middle), s = std::sin(middle);
      const double dx = forward * c - sideways * s, dy = forward * s + sideways * c;
      pieces_.push_back({static_cast<int>(i), static_cast<float>(share), dx, dy, c, s});
      pose = {pose.x_m + dx, pose.y_m + dy, pose.heading_rad + turn};
      now_s = until_s;
    }
  }
  first_piece_.push_back(static_cast<int>(pieces_.size()));
}

// `motion(t, j)` writes the derivative of the motion from truth sample t to t + 1, in the frame of t.
template <typename Motion>
Stretch LinearisedRun::carried(Motion&& motion, int first, int last_with_motion, int parameter, double* out) const {
  const int n = samples();
  double d0 = 0.0, d1 = 0.0, d2 = 0.0;
  double largest = 0.0;
  const auto start_at = [&](const FilterStep& step) {
    d0 = d1 = d2 = 0.0;
    const double c = std::cos(step.heading_rad), s = std::sin(step.heading_rad);
    if (parameter == column::mounting_x) d0 = -c, d1 = -s;
    if (parameter == column::mounting_y) d0 = s, d1 = -c;
    if (parameter == column::mounting_heading && run_->truth_has_heading)
      d0 = -step.arm.y_m, d1 = step.arm.x_m, d2 = -1.0;
  };
  const bool mounting = parameter >= column::mounting_x && parameter <= column::mounting_heading;
  if (first == 0 && steps_[0].starts) start_at(steps_[0]);
  out[3 * first] = out[3 * first + 1] = out[3 * first + 2] = 0.0;
  for (int t = first; t + 1 < n; ++t) {
    const FilterStep& step = steps_[t + 1];
    double* o = out + 3 * (t + 1);
    o[0] = o[1] = o[2] = 0.0;
    if (step.truth_index < 0) continue;  // before the filter's start
    if (step.starts) {
      start_at(step);
      continue;
    }
    const double c = turned_[t + 1].c0, s = turned_[t + 1].s0;
    double jac[3] = {0.0, 0.0, 0.0};
    if (t < last_with_motion) motion(t, jac);
    d0 += -step.moved.y_m * d2 + c * jac[0] - s * jac[1];
    d1 += step.moved.x_m * d2 + s * jac[0] + c * jac[1];
    d2 += jac[2];
    if (!step.used) continue;
    double j0 = d0 - step.arm.y_m * d2, j1 = d1 + step.arm.x_m * d2, j2 = d2;
    if (mounting) {
      const double ch = turned_[t + 1].c1, sh = turned_[t + 1].s1;
      if (parameter == column::mounting_x) j0 += ch, j1 += sh;
      if (parameter == column::mounting_y) j0 -= sh, j1 += ch;
      if (parameter == column::mounting_heading) j2 += 1.0;
    }
    if (step.size == 2) j2 = 0.0;
    const double* w = &whitener_[9 * static_cast<std::size_t>(t + 1)];
    for (int r = 0; r < 3; ++r) o[r] = (w[3 * r] * j0 + w[3 * r + 1] * j1 + w[3 * r + 2] * j2);
    d0 -= step.gain[0] * j0 + step.gain[1] * j1 + step.gain[2] * j2;
    d1 -= step.gain[3] * j0 + step.gain[4] * j1 + step.gain[5] * j2;
    d2 -= step.gain[6] * j0 + step.gain[7] * j1 + step.gain[8] * j2;
    if (t >= last_with_motion) {  // behind a short event nothing is left after a while
      const double size = std::abs(o[0]) + std::abs(o[1]) + std::abs(o[2]);
      if (size < 1e-3 * largest && t > last_with_motion + 5) return {first, t + 2};
    } else {
      largest = std::max(largest, static_cast<double>(std::abs(o[0]) + std::abs(o[1]) + std::abs(o[2])));
    }
  }
  return {first, n};
}

Stretch LinearisedRun::of_motion(const Motions& motions, double* out) const {
  const auto moves = [&](std::size_t step) {
    const BodyMotion& m = motions[step];
    return m.forward_m != 0.0 || m.sideways_m != 0.0 || m.turn_rad != 0.0;
  };
  std::size_t first = motions.first(), end = motions.end();
  while (first < end && !moves(first)) ++first;
  if (first == end) return {0, 0};
  while (!moves(end - 1)) --end;
  const int from_step = static_cast<int>(first), to_step = static_cast<int>(end) - 1;
  // Truth intervals that touch these wheel intervals.
  const auto piece_of = [&](int step) {
    return static_cast<int>(
        std::lower_bound(pieces_.begin(), pieces_.end(), step, [](const Piece& p, int s) { return p.interval < s; }) -
        pieces_.begin());
  };
  const int n = samples();
  const auto truth_of = [&](int piece) {
    return static_cast<int>(std::upper_bound(first_piece_.begin(), first_piece_.end(), piece) - first_piece_.begin()) -
           1;
  };
  const int t0 = std::clamp(truth_of(piece_of(from_step)), 0, n - 1);
  const int t1 = std::clamp(truth_of(piece_of(to_step + 1)) + 1, 0, n - 1);
  if (t0 >= n - 1) return {0, 0};
  const auto motion = [&](int t, double* d) {
    for (int p = first_piece_[t]; p < first_piece_[t + 1]; ++p) {
      const Piece& piece = pieces_[p];
      const BodyMotion m = motions.at(static_cast<std::size_t>(piece.interval));
      const double f = piece.share * m.forward_m, l = piece.share * m.sideways_m, w = piece.share * m.turn_rad;
      d[0] += -piece.dy * d[2] + piece.c * f - piece.s * l - 0.5 * piece.dy * w;
      d[1] += piece.dx * d[2] + piece.s * f + piece.c * l + 0.5 * piece.dx * w;
      d[2] += w;
    }
  };
  return carried(motion, t0, t1, -1, out);
}

// `carried` and `of_motion` the other way about: each line is the transpose of one there.
std::vector<BodyMotion> LinearisedRun::score_of_motions(const double* whitened) const {
  std::vector<BodyMotion> score(run_->wheels.size() - 1);
  double a0 = 0.0, a1 = 0.0, a2 = 0.0;  // by the derivative of the pose behind sample t + 1
  for (int t = samples() - 2; t >= 0; --t) {
    const FilterStep& step = steps_[t + 1];
    if (step.truth_index < 0 || step.starts) {
      a0 = a1 = a2 = 0.0;
      continue;
    }
    if (step.used) {
      const double* w = &whitener_[9 * static_cast<std::size_t>(t + 1)];
      const double* o = whitened + 3 * (t + 1);
      double j[3];
      for (int k = 0; k < 3; ++k)
        j[k] = w[k] * o[0] + w[3 + k] * o[1] + w[6 + k] * o[2] -
               (step.gain[k] * a0 + step.gain[3 + k] * a1 + step.gain[6 + k] * a2);
      if (step.size == 2) j[2] = 0.0;
      a0 += j[0];
      a1 += j[1];
      a2 += -step.arm.y_m * j[0] + step.arm.x_m * j[1] + j[2];
    }
    const double c0 = turned_[t + 1].c0, s0 = turned_[t + 1].s0;
    const double d0 = c0 * a0 + s0 * a1, d1 = -s0 * a0 + c0 * a1;
    double d2 = a2;
    for (int p = first_piece_[t + 1] - 1; p >= first_piece_[t]; --p) {
      const Piece& piece = pieces_[p];
      BodyMotion& sum = score[static_cast<std::size_t>(piece.interval)];
      sum.forward_m += piece.share * (piece.c * d0 + piece.s * d1);
      sum.sideways_m += piece.share * (-piece.s * d0 + piece.c * d1);
      sum.turn_rad += piece.share * (-0.5 * piece.dy * d0 + 0.5 * piece.dx * d1 + d2);
      d2 += -piece.dy * d0 + piece.dx * d1;
    }
    a2 += -step.moved.y_m * a0 + step.moved.x_m * a1;
  }
  return score;
}

void LinearisedRun::of_parameter(int parameter, double* out) const {
  const auto motion = [&](int t, double* d) {
    const double* jac = &summed_.derivatives[3 * (static_cast<std::size_t>(summed_.columns) * t + parameter)];
    for (int k = 0; k < 3; ++k) d[k] = jac[k];
  };
  carried(motion, 0, samples(), parameter, out);
}

void LinearisedRun::of_clock_rate(double* out) const {
  // A clock that runs fast is an offset that grows: at both ends of a motion the body's velocity there, times the time
  // since the first sample. The clock's own derivative holds the difference of both; the end's part is split off.
  const auto motion = [&](int t, double* d) {
    if (first_piece_[t] >= first_piece_[t + 1]) return;
    const double t0 = run_->truth[t].time_s - run_->truth[0].time_s,
                 t1 = run_->truth[t + 1].time_s - run_->truth[0].time_s;
    const double* jac = &summed_.derivatives[3 * (static_cast<std::size_t>(summed_.columns) * t + column::truth_clock)];
    const double* end = &summed_.end_velocity[3 * static_cast<std::size_t>(t)];
    // offset(t) = -rate (t - t_0): jac = start velocity - end velocity
    for (int k = 0; k < 3; ++k) d[k] = -(t0 * (jac[k] + end[k]) - t1 * end[k]);
    // The start's velocity also swings the motion about, which jac has in it already.
  };
  carried(motion, 0, samples(), -1, out);
}

}  // namespace odolab
