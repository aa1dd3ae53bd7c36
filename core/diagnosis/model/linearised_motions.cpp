// What motions of the body do to a linearised run: core/diagnosis/README.md, Eqs. 3 and 15.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>

#include "core/diagnosis/model/linearised.h"
#include "core/diagnosis/model/off_truth.h"

namespace odolab {

// The same pieces that summed_up walks through.
void LinearisedRun::cut_into_pieces() {
  const InnovationRun& run = *run_;
  const auto& wheels = run.wheels;
  const int n = samples();
  const double b = model_.drive.wheelbase_m;
  std::size_t i = 0;
  double now_s = run.truth[0].time_s - model_.truth.time_offset_s;
  pieces_.reserve(wheels.size() + run.truth.size());
  first_piece_.reserve(run.truth.size());
  for (int t = 0; t + 1 < n; ++t) {
    const std::size_t first = pieces_.size();
    first_piece_.push_back(static_cast<int>(first));
    const double end_s = run.truth[t + 1].time_s - model_.truth.time_offset_s;
    double heading_rad = 0.0;
    while (now_s < end_s) {
      while (i + 2 < wheels.size() && wheels[i + 1].time_s <= now_s) ++i;
      const double until_s = i + 2 >= wheels.size() ? end_s : std::min(end_s, wheels[i + 1].time_s);
      const double share = (until_s - now_s) / (wheels[i + 1].time_s - wheels[i].time_s);
      const double left_m = model_.drive.wheel_radius_left_m * share * (wheels[i + 1].left_rad - wheels[i].left_rad);
      const double right_m =
          model_.drive.wheel_radius_right_m * share * (wheels[i + 1].right_rad - wheels[i].right_rad);
      double forward = 0.5 * (left_m + right_m), sideways = 0.0, turn = (right_m - left_m) / b;
      for (const ExtraColumn& e : run.extra) {
        forward += share * e.value * e.per_step[i].forward_m;
        sideways += share * e.value * e.per_step[i].sideways_m;
        turn += share * e.value * e.per_step[i].turn_rad;
      }
      const Turn middle = turn_of(heading_rad + 0.5 * turn);
      const double chord = chord_share(turn), c = chord * middle.c, s = chord * middle.s;
      const double dx = forward * c - sideways * s, dy = forward * s + sideways * c;
      // In the frame of the truth interval's start, and so far where this piece ends.
      const double slope = chord_share_slope(turn);
      pieces_.push_back(
          {static_cast<int>(i), t, share, share * c, share * s, slope * dx - 0.5 * dy, slope * dy + 0.5 * dx});
      for (std::size_t p = first; p + 1 < pieces_.size(); ++p) pieces_[p].turn_x -= dy, pieces_[p].turn_y += dx;
      heading_rad += turn;
      now_s = until_s;
    }
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    const auto into_room = [&](double& x, double& y) {
      const double ahead = x, aside = y;
      x = carry.c * ahead - carry.s * aside;
      y = carry.s * ahead + carry.c * aside;
    };
    for (std::size_t p = first; p < pieces_.size(); ++p) {
      Piece& piece = pieces_[p];
      piece.turn_x *= piece.share;
      piece.turn_y *= piece.share;
      into_room(piece.forward_x, piece.forward_y);
      into_room(piece.turn_x, piece.turn_y);
    }
  }
  first_piece_.push_back(static_cast<int>(pieces_.size()));
  piece_of_wheels_.assign(wheels.size(), static_cast<int>(pieces_.size()));
  for (int p = static_cast<int>(pieces_.size()); p-- > 0;)
    piece_of_wheels_[static_cast<std::size_t>(pieces_[p].interval)] = p;
  for (std::size_t k = wheels.size() - 1; k-- > 0;)
    piece_of_wheels_[k] = std::min(piece_of_wheels_[k], piece_of_wheels_[k + 1]);
}

Stretch LinearisedRun::touched(std::size_t first, std::size_t end) const {
  const int n = samples(), all = static_cast<int>(pieces_.size());
  const auto truth_of = [&](int piece) { return piece < all ? pieces_[piece].truth : n - 1; };
  return {std::clamp(truth_of(piece_of_wheels_[first]), 0, n - 1),
          std::clamp(truth_of(piece_of_wheels_[end]) + 1, 0, n - 1)};
}

// `of_motion` the other way about: each line is the transpose of one there.
std::vector<double> LinearisedRun::score_of_intervals(const double* whitened) const {
  const int n = samples();
  std::vector<double> score(3 * static_cast<std::size_t>(n - 1));
  double a0 = 0.0, a1 = 0.0, a2 = 0.0;  // by the derivative of the pose behind sample t + 1
  OffTruth<double> off;
  for (int t = n - 2; t >= 0; --t) {
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    const double* o = whitened + 3 * (t + 1);
    double* e = &score[3 * static_cast<std::size_t>(t)];
    for (int k = 0; k < 3; ++k)
      e[k] = carry.out[k] * o[0] + carry.out[3 + k] * o[1] + carry.out[6 + k] * o[2] + carry.on[k] * a0 +
             carry.on[3 + k] * a1 + carry.on[6 + k] * a2;
    if (truth_comes_back()) off.go_back(truth_carry_[static_cast<std::size_t>(t) + 1], o, a0, a1, a2, e);
    a0 = e[0];
    a1 = e[1];
    a2 = e[2] - carry.dy * e[0] + carry.dx * e[1];
  }
  return score;
}

std::vector<BodyMotion> LinearisedRun::score_of_motions(const double* whitened) const {
  const std::vector<double> of_intervals = score_of_intervals(whitened);
  std::vector<BodyMotion> score(run_->wheels.size() - 1);
  for (std::size_t p = pieces_.size(); p-- > 0;) {
    const Piece& piece = pieces_[p];
    const double* e = &of_intervals[3 * static_cast<std::size_t>(piece.truth)];
    BodyMotion& sum = score[static_cast<std::size_t>(piece.interval)];
    sum.forward_m += piece.forward_x * e[0] + piece.forward_y * e[1];
    sum.sideways_m += -piece.forward_y * e[0] + piece.forward_x * e[1];
    sum.turn_rad += piece.turn_x * e[0] + piece.turn_y * e[1] + piece.share * e[2];
  }
  return score;
}

void LinearisedRun::move(const std::vector<std::vector<Motions>>& candidates, Moved& moved) const {
  moved.abreast = candidates.size();
  moved.columns.clear();
  moved.parts.clear();
  std::size_t most = 0;
  for (const std::vector<Motions>& c : candidates) most = std::max(most, c.size());
  for (std::size_t j = 0; j < most; ++j) {
    bool acts = false;
    for (const std::vector<Motions>& c : candidates) {
      if (c.empty() || c[j].empty()) continue;
      acts = true;
      for (const Motions::Stretch& stretch : c[j].stretches())
        if (const Stretch t = touched(stretch.first, stretch.end); t.last > t.first)
          moved.parts.push_back({t.first, t.last, 0});
    }
    if (acts) moved.columns.push_back(j);
  }
  const auto in_order = [](const Moved::Part& a, const Moved::Part& b) { return a.first < b.first; };
  std::sort(moved.parts.begin(), moved.parts.end(), in_order);
  std::size_t intervals = 0, parts = 0;
  for (const Moved::Part& p : moved.parts) {
    if (parts > 0 && p.first <= moved.parts[parts - 1].end)
      moved.parts[parts - 1].end = std::max(moved.parts[parts - 1].end, p.end);
    else
      moved.parts[parts++] = p;
  }
  moved.parts.resize(parts);
  for (Moved::Part& p : moved.parts) {
    p.held_before = intervals;
    intervals += static_cast<std::size_t>(p.end - p.first);
  }
  const std::size_t columns = moved.columns.size(), abreast = moved.abreast;
  moved.by.assign(3 * columns * abreast * intervals, 0.0);
  moved.any.assign(intervals, 0);
  for (std::size_t l = 0; l < abreast; ++l)
    for (std::size_t j = 0; j < columns; ++j) {
      if (candidates[l].empty() || candidates[l][moved.columns[j]].empty()) continue;
      const Motions& motions = candidates[l][moved.columns[j]];
      for (const Motions::Stretch& stretch : motions.stretches()) {
        const int first = piece_of_wheels_[stretch.first], last = piece_of_wheels_[stretch.end];
        if (first >= last) continue;
        const Moved::Part& part = *std::prev(std::upper_bound(moved.parts.begin(), moved.parts.end(),
                                                              Moved::Part{pieces_[first].truth, 0, 0}, in_order));
        const BodyMotion* of_stretch = motions.from(stretch.first);
        for (int p = first; p < last;) {
          const int truth = pieces_[p].truth;
          double x = 0.0, y = 0.0, h = 0.0;
          for (; p < last && pieces_[p].truth == truth; ++p) {
            const Piece& piece = pieces_[p];
            const BodyMotion& m = of_stretch[static_cast<std::size_t>(piece.interval) - stretch.first];
            x += piece.forward_x * m.forward_m - piece.forward_y * m.sideways_m + piece.turn_x * m.turn_rad;
            y += piece.forward_y * m.forward_m + piece.forward_x * m.sideways_m + piece.turn_y * m.turn_rad;
            h += piece.share * m.turn_rad;
          }
          if (x == 0.0 && y == 0.0 && h == 0.0) continue;
          const std::size_t n = part.held_before + static_cast<std::size_t>(truth - part.first);
          double* by = &moved.by[(n * columns + j) * 3 * abreast + l];
          by[0] += x;  // two stretches may share an interval
          by[abreast] += y;
          by[2 * abreast] += h;
          moved.any[n] = 1;
        }
      }
    }
}

// Of those columns of `moved` that `which` numbers.
template <int columns, int abreast, bool comes_back>
void LinearisedRun::products(const Moved& moved, const std::size_t* which, const Tails& tails, double* products) const {
  using Lanes = Eigen::Array<double, abreast, 1>;
  constexpr int k = columns, m = abreast;
  Lanes d[3][k], sum[k][k];
  std::conditional_t<comes_back, OffTruth<Lanes>, char> off[k];
  for (auto& row : d) std::fill(row, row + k, Lanes::Zero());
  for (auto& row : sum) std::fill(row, row + k, Lanes::Zero());
  const std::size_t stride = 3 * m * moved.columns.size();
  // Between one time and the next that something moves, what it left behind is soon nothing.
  constexpr int kAskedEvery = 16;
  constexpr double kNothing = 1e-7;  // of the largest that moved anything
  double largest = 0.0;
  const auto is_forgotten = [&] {
    double left = 0.0;
    for (int j = 0; j < k; ++j)
      for (const auto& row : d) left = std::max(left, row[j].abs().maxCoeff());
    if constexpr (comes_back)
      for (const auto& of : off)
        for (const Lanes& row : of.by) left = std::max(left, row.abs().maxCoeff());
    largest = std::max(largest, left);
    return left <= kNothing * largest;
  };
  const std::vector<double> at_rest(stride, 0.0);
  const auto go_on = [&](int t, const double* by) {
    const Carry& carry = carry_[static_cast<std::size_t>(t) + 1];
    Lanes o[3][k];
    for (int j = 0; j < k; ++j) {
      const double* u = by + 3 * m * which[j];
      const Lanes e0 = d[0][j] - carry.dy * d[2][j] + Eigen::Map<const Lanes>(u);
      const Lanes e1 = d[1][j] + carry.dx * d[2][j] + Eigen::Map<const Lanes>(u + m);
      const Lanes e2 = d[2][j] + Eigen::Map<const Lanes>(u + 2 * m);
      for (int r = 0; r < 3; ++r) {
        o[r][j] = carry.out[3 * r] * e0 + carry.out[3 * r + 1] * e1 + carry.out[3 * r + 2] * e2;
        d[r][j] = carry.on[3 * r] * e0 + carry.on[3 * r + 1] * e1 + carry.on[3 * r + 2] * e2;
      }
      if constexpr (comes_back) {
        Lanes whitened[3] = {o[0][j], o[1][j], o[2][j]};
        off[j].go_on(truth_carry_[static_cast<std::size_t>(t) + 1], e0, e1, e2, whitened, d[0][j], d[1][j], d[2][j]);
        for (int r = 0; r < 3; ++r) o[r][j] = whitened[r];
      }
    }
    for (int i = 0; i < k; ++i)
      for (int j = i; j < k; ++j) sum[i][j] += o[0][i] * o[0][j] + o[1][i] * o[1][j] + o[2][i] * o[2][j];
  };
  int end = 0;
  for (const Moved::Part& part : moved.parts) {
    for (int t = end; end > 0 && t < part.first; ++t) {
      if (t % kAskedEvery == 0 && is_forgotten()) {
        for (auto& row : d) std::fill(row, row + k, Lanes::Zero());
        if constexpr (comes_back) std::fill(off, off + k, OffTruth<Lanes>{});
        break;
      }
      go_on(t, at_rest.data());
    }
    end = part.end;
    for (int t = part.first; t < end; ++t)
      go_on(t, &moved.by[stride * (part.held_before + static_cast<std::size_t>(t - part.first))]);
  }
  const auto put = [&](int i, int j, const Lanes& product) {
    for (int l = 0; l < m; ++l) products[(i * k + j) * m + l] = products[(j * k + i) * m + l] = product(l);
  };
  if constexpr (comes_back) {
    const Eigen::Matrix<double, 6, 6>& s = tails.of_both[static_cast<std::size_t>(end)];
    const auto state = [&](int j, int r) -> const Lanes& { return r < 3 ? d[r][j] : off[j].by[r - 3]; };
    for (int i = 0; i < k; ++i)
      for (int j = i; j < k; ++j) {
        Lanes product = sum[i][j];
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) product += s(r, c) * state(i, r) * state(j, c);
        put(i, j, product);
      }
    return;
  }
  if constexpr (!comes_back) {
    const std::array<double, 6>& s = tails.of_pose[static_cast<std::size_t>(end)];
    for (int i = 0; i < k; ++i)
      for (int j = i; j < k; ++j) {
        const Lanes x = s[0] * d[0][j] + s[1] * d[1][j] + s[2] * d[2][j];
        const Lanes y = s[1] * d[0][j] + s[3] * d[1][j] + s[4] * d[2][j];
        const Lanes h = s[2] * d[0][j] + s[4] * d[1][j] + s[5] * d[2][j];
        put(i, j, sum[i][j] + d[0][i] * x + d[1][i] * y + d[2][i] * h);
      }
  }
}

template <int abreast, bool comes_back>
void LinearisedRun::products_of_all(const Moved& moved, const Tails& tails, double* out) const {
  const std::size_t count = moved.columns.size();
  const std::size_t in_order[3] = {0, 1, 2};
  if (count == 1) return products<1, abreast, comes_back>(moved, in_order, tails, out);
  if (count == 2) return products<2, abreast, comes_back>(moved, in_order, tails, out);
  if (count == 3) return products<3, abreast, comes_back>(moved, in_order, tails, out);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const std::size_t pair[2] = {i, j};
      double made[4 * abreast];
      products<2, abreast, comes_back>(moved, pair, tails, made);
      for (std::size_t l = 0; l < abreast; ++l) {
        out[(i * count + i) * abreast + l] = made[l];
        out[(j * count + j) * abreast + l] = made[3 * abreast + l];
        out[(i * count + j) * abreast + l] = out[(j * count + i) * abreast + l] = made[abreast + l];
      }
    }
}

void LinearisedRun::products_of(const Moved& moved, const Tails& tails, std::vector<double>& products) const {
  products.assign(moved.columns.size() * moved.columns.size() * moved.abreast, 0.0);
  if (moved.columns.empty()) return;
  constexpr int kMany = static_cast<int>(kAbreast);
  const bool one = moved.abreast == 1;
  if (truth_comes_back())
    one ? products_of_all<1, true>(moved, tails, products.data())
        : products_of_all<kMany, true>(moved, tails, products.data());
  else
    one ? products_of_all<1, false>(moved, tails, products.data())
        : products_of_all<kMany, false>(moved, tails, products.data());
}

}  // namespace odolab
