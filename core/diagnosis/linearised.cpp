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
  prepare_carry();
}

void LinearisedRun::prepare_carry() {
  const int n = samples();
  carry_.resize(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const FilterStep& step = steps_[k];
    Carry& carry = carry_[static_cast<std::size_t>(k)];
    if (step.truth_index < 0 || step.starts) continue;
    carry.c = turned_[k].c0;
    carry.s = turned_[k].s0;
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
}

LinearisedRun::Tails LinearisedRun::tails() const {
  const int n = samples();
  Tails tails(static_cast<std::size_t>(n), {0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  for (int k = n - 1; k > 0; --k) {
    const Carry& carry = carry_[static_cast<std::size_t>(k)];
    const std::array<double, 6>& s = tails[static_cast<std::size_t>(k)];
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
    tails[static_cast<std::size_t>(k) - 1] = {of_e[0], of_e[1], xh, of_e[4], yh, -carry.dy * xh + carry.dx * yh + eh};
  }
  return tails;
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
      if (size < 1e-6 * largest && t > last_with_motion + 5) return {first, t + 2};
    } else {
      largest = std::max(largest, static_cast<double>(std::abs(o[0]) + std::abs(o[1]) + std::abs(o[2])));
    }
  }
  return {first, n};
}

Stretch LinearisedRun::touched(std::size_t first, std::size_t end) const {
  const auto piece_of = [&](std::size_t step) {
    return static_cast<int>(std::lower_bound(pieces_.begin(), pieces_.end(), static_cast<int>(step),
                                             [](const Piece& p, int s) { return p.interval < s; }) -
                            pieces_.begin());
  };
  const int n = samples();
  const auto truth_of = [&](int piece) {
    return static_cast<int>(std::upper_bound(first_piece_.begin(), first_piece_.end(), piece) - first_piece_.begin()) -
           1;
  };
  return {std::clamp(truth_of(piece_of(first)), 0, n - 1), std::clamp(truth_of(piece_of(end)) + 1, 0, n - 1)};
}

namespace {

// The steps in which something moves, within those that the motions hold.
std::pair<std::size_t, std::size_t> moving(const Motions& motions) {
  const auto moves = [&](std::size_t step) {
    const BodyMotion& m = motions[step];
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
  out[3 * first] = out[3 * first + 1] = out[3 * first + 2] = 0.0;
  for (int t = first; t + 1 < n; ++t) {
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    double e0 = d0 - carry.dy * d2, e1 = d1 + carry.dx * d2, e2 = d2;
    if (t < with_motion.last) {
      double jac[3] = {0.0, 0.0, 0.0};
      add_motion(motions, t, jac);
      e0 += carry.c * jac[0] - carry.s * jac[1];
      e1 += carry.s * jac[0] + carry.c * jac[1];
      e2 += jac[2];
    }
    double* const o = out + 3 * (t + 1);
    for (int r = 0; r < 3; ++r) o[r] = carry.out[3 * r] * e0 + carry.out[3 * r + 1] * e1 + carry.out[3 * r + 2] * e2;
    d0 = carry.on[0] * e0 + carry.on[1] * e1 + carry.on[2] * e2;
    d1 = carry.on[3] * e0 + carry.on[4] * e1 + carry.on[5] * e2;
    d2 = carry.on[6] * e0 + carry.on[7] * e1 + carry.on[8] * e2;
    const double size = std::abs(o[0]) + std::abs(o[1]) + std::abs(o[2]);
    if (t < with_motion.last) {
      largest = std::max(largest, size);
    } else if (steps_[t + 1].used && size < 1e-6 * largest && t > with_motion.last + 5) {
      return {first, t + 2};  // behind a short event nothing is left after a while
    }
  }
  return {first, n};
}

template <int k>
void LinearisedRun::products(const Motions* const* motions, const Tails& tails, double* products) const {
  std::size_t first_step = motions[0]->first(), end_step = motions[0]->end();
  for (int j = 1; j < k; ++j) {
    first_step = std::min(first_step, motions[j]->first());
    end_step = std::max(end_step, motions[j]->end());
  }
  const Stretch with_motion = touched(first_step, end_step);
  double d[3][k] = {}, sum[k][k] = {};
  for (int t = with_motion.first; t < with_motion.last; ++t) {
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    double e[3][k];
    for (int j = 0; j < k; ++j) {
      double jac[3] = {0.0, 0.0, 0.0};
      add_motion(*motions[j], t, jac);
      e[0][j] = d[0][j] - carry.dy * d[2][j] + carry.c * jac[0] - carry.s * jac[1];
      e[1][j] = d[1][j] + carry.dx * d[2][j] + carry.s * jac[0] + carry.c * jac[1];
      e[2][j] = d[2][j] + jac[2];
    }
    for (int r = 0; r < 3; ++r) {
      double o[k];
      for (int j = 0; j < k; ++j)
        o[j] = carry.out[3 * r] * e[0][j] + carry.out[3 * r + 1] * e[1][j] + carry.out[3 * r + 2] * e[2][j];
      for (int i = 0; i < k; ++i)
        for (int j = i; j < k; ++j) sum[i][j] += o[i] * o[j];
      for (int j = 0; j < k; ++j)
        d[r][j] = carry.on[3 * r] * e[0][j] + carry.on[3 * r + 1] * e[1][j] + carry.on[3 * r + 2] * e[2][j];
    }
  }
  const std::array<double, 6>& s = tails[static_cast<std::size_t>(with_motion.last)];
  for (int i = 0; i < k; ++i)
    for (int j = i; j < k; ++j) {
      const double x = s[0] * d[0][j] + s[1] * d[1][j] + s[2] * d[2][j];
      const double y = s[1] * d[0][j] + s[3] * d[1][j] + s[4] * d[2][j];
      const double h = s[2] * d[0][j] + s[4] * d[1][j] + s[5] * d[2][j];
      products[i * k + j] = products[j * k + i] = sum[i][j] + d[0][i] * x + d[1][i] * y + d[2][i] * h;
    }
}

void LinearisedRun::products_of_motions(const std::vector<Motions>& motions, const Tails& tails, double* out) const {
  const std::size_t count = motions.size();
  std::fill(out, out + count * count, 0.0);
  std::vector<std::size_t> acting;
  for (std::size_t j = 0; j < count; ++j)
    if (!motions[j].empty()) acting.push_back(j);
  if (acting.empty()) return;
  const auto put = [&](std::size_t i, std::size_t j, double value) {
    out[acting[i] * count + acting[j]] = out[acting[j] * count + acting[i]] = value;
  };
  if (acting.size() <= 3) {
    const Motions* of[3] = {};
    for (std::size_t j = 0; j < acting.size(); ++j) of[j] = &motions[acting[j]];
    double made[9];
    if (acting.size() == 1) products<1>(of, tails, made);
    if (acting.size() == 2) products<2>(of, tails, made);
    if (acting.size() == 3) products<3>(of, tails, made);
    for (std::size_t i = 0; i < acting.size(); ++i)
      for (std::size_t j = i; j < acting.size(); ++j) put(i, j, made[i * acting.size() + j]);
    return;
  }
  for (std::size_t i = 0; i < acting.size(); ++i)  // in pairs
    for (std::size_t j = i; j < acting.size(); ++j) {
      const Motions* of[2] = {&motions[acting[i]], &motions[acting[j]]};
      double made[4];
      products<2>(of, tails, made);
      put(i, j, made[1]);
    }
}

// `carried` and `of_motion` the other way about: each line is the transpose of one there.
std::vector<BodyMotion> LinearisedRun::score_of_motions(const double* whitened) const {
  std::vector<BodyMotion> score(run_->wheels.size() - 1);
  double a0 = 0.0, a1 = 0.0, a2 = 0.0;  // by the derivative of the pose behind sample t + 1
  for (int t = samples() - 2; t >= 0; --t) {
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    const double* o = whitened + 3 * (t + 1);
    double e[3];
    for (int k = 0; k < 3; ++k)
      e[k] = carry.out[k] * o[0] + carry.out[3 + k] * o[1] + carry.out[6 + k] * o[2] + carry.on[k] * a0 +
             carry.on[3 + k] * a1 + carry.on[6 + k] * a2;
    a0 = e[0];
    a1 = e[1];
    a2 = e[2];
    const double d0 = carry.c * a0 + carry.s * a1, d1 = -carry.s * a0 + carry.c * a1;
    double d2 = a2;
    for (int p = first_piece_[t + 1] - 1; p >= first_piece_[t]; --p) {
      const Piece& piece = pieces_[p];
      BodyMotion& sum = score[static_cast<std::size_t>(piece.interval)];
      sum.forward_m += piece.share * (piece.c * d0 + piece.s * d1);
      sum.sideways_m += piece.share * (-piece.s * d0 + piece.c * d1);
      sum.turn_rad += piece.share * (-0.5 * piece.dy * d0 + 0.5 * piece.dx * d1 + d2);
      d2 += -piece.dy * d0 + piece.dx * d1;
    }
    a2 += -carry.dy * a0 + carry.dx * a1;
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
