#include "core/calibration/run_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"
#include "core/calibration/wheels_at.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Long enough that clocks apart by a tenth of a second matter little, short enough for one arc and for a turn not to be
// taken for another.
constexpr double kShortestStretch_s = 0.5, kLongEnough_s = 2.0, kLongestStretch_s = 5.0;
constexpr double kLongEnough_m = 0.2, kLongEnough_rad = 0.6;
constexpr double kMoves_m = 0.02, kMoves_rad = 0.06;  // what moves less is lost in the truth's noise
constexpr std::size_t kFewestRunStretches = 8;
constexpr double kLeastDriven_m = 0.5, kLeastTurned_rad = 2.0;  // in all, by the wheels
constexpr int kRounds = 4;
constexpr double kWorstStretches = 0.1;  // share of the stretches that need no explanation: jumps, pushes

// What acts in turns and along the room beside the mounting, and how large it may be: sideways slip by speed and turn
// [s], way lost for a turn [m], creep of the floor [m/s].
constexpr double kSlip_s = 0.03, kLost_m = 0.01, kCreep_mps = 0.005;

struct RunStretch {
  double duration_s = 0.0;
  double rolled_m = 0.0, rolled_rad = 0.0;  // way and turn by the vehicle file's wheels
  Vec2 moved;                               // the tracked point, in the frame of the truth's middle heading
  double turn_rad = 0.0;                    // of the truth, wrapped
  double middle_rad = 0.0;
  double chord_m = 0.0;  // of the tracked point

  bool rolls() const { return std::abs(rolled_m) > kMoves_m; }
};

std::vector<RunStretch> run_stretches(const Recording& recording, const Vehicle& nominal, bool headings) {
  const DifferentialDrive& drive = std::get<DifferentialDrive>(nominal.kind);
  const std::vector<WheelSample> wheels = wheel_samples(recording, drive);
  std::vector<RunStretch> stretches;
  if (wheels.size() < 2) return stretches;
  const double first_s = wheels.front().time_s, last_s = wheels.back().time_s;
  std::optional<TruthSample> from;
  WheelSample from_wheels;
  for (const TruthSample& to : truth_samples(recording)) {
    const double time_s = to.time_s - nominal.truth.time_offset_s;
    if (time_s < first_s || time_s > last_s || (headings && !to.heading_rad)) continue;
    if (from && to.time_s - from->time_s < kShortestStretch_s) continue;
    const WheelSample now = wheels_at(wheels, time_s);
    if (from) {
      RunStretch s;
      const double left_m = drive.wheel_radius_left_m * (now.left_rad - from_wheels.left_rad),
                   right_m = drive.wheel_radius_right_m * (now.right_rad - from_wheels.right_rad);
      s.duration_s = to.time_s - from->time_s;
      s.rolled_m = 0.5 * (left_m + right_m);
      s.rolled_rad = (right_m - left_m) / drive.wheelbase_m;
      if (s.duration_s < kLongEnough_s && std::abs(s.rolled_m) < kLongEnough_m &&
          std::abs(s.rolled_rad) < kLongEnough_rad)
        continue;
      const Vec2 way = to.position - from->position;
      s.chord_m = length(way);
      if (headings) {
        s.turn_rad = wrapped(*to.heading_rad - *from->heading_rad);
        s.middle_rad = *from->heading_rad + 0.5 * s.turn_rad;
        s.moved = rotated(way, -s.middle_rad);
      }
      const bool moves = std::abs(s.rolled_m) > kMoves_m || std::abs(s.rolled_rad) > kMoves_rad;
      if (s.duration_s <= kLongestStretch_s && moves) stretches.push_back(s);
    }
    from = to;
    from_wheels = now;
  }
  return stretches;
}

// Weighted rows of a linear problem, `each` of them to a stretch; weak priors of these widths, 0 for none. What is an
// outlier goes by what `telling` stretches miss: of many turns on the spot and few ways all ways would be one.
struct Solution {
  VectorXd x, stderrs;
  double explained = 1.0;
};

Solution solved(const MatrixXd& rows, const VectorXd& y, int each, const std::vector<double>& priors,
                const std::vector<char>& telling) {
  const Eigen::Index n = rows.cols(), stretches = rows.rows() / each;
  const auto size_of = [&](const VectorXd& v, Eigen::Index i) { return v.segment(i * each, each).squaredNorm(); };
  std::vector<char> used(static_cast<std::size_t>(stretches), 1);
  Solution s;
  double variance = 1e-6 + y.squaredNorm() / static_cast<double>(y.size());
  MatrixXd inverse;
  VectorXd left;
  for (int round = 0; round < kRounds; ++round) {
    MatrixXd information = MatrixXd::Zero(n, n);
    VectorXd gradient = VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < stretches; ++i) {
      if (!used[static_cast<std::size_t>(i)]) continue;
      const auto block = rows.middleRows(i * each, each);
      information += block.transpose() * block;
      gradient += block.transpose() * y.segment(i * each, each);
    }
    const double stiffness = 1e-9 * information.trace() + 1e-12;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double width = priors[static_cast<std::size_t>(k)];
      information(k, k) += width > 0.0 ? variance / (width * width) : stiffness;
    }
    inverse = information.inverse();
    s.x = inverse * gradient;
    left = y - rows * s.x;
    std::vector<double> misses, of_telling;
    for (Eigen::Index i = 0; i < stretches; ++i) {
      misses.push_back(std::sqrt(size_of(left, i)));
      if (telling[static_cast<std::size_t>(i)]) of_telling.push_back(misses.back());
    }
    const double gate = 3.0 * scatter_about_zero(std::move(of_telling)) + 1e-9;
    double squares = 0.0, count = 0.0;
    for (std::size_t i = 0; i < misses.size(); ++i) {
      used[i] = misses[i] <= gate;
      if (used[i]) squares += misses[i] * misses[i], count += each;
    }
    variance = squares / std::max(1.0, count - static_cast<double>(n)) + 1e-12;
  }
  // What hangs together from one stretch to the next says less than it seems.
  double next = 0.0, own = 1e-30;
  for (Eigen::Index i = 0; i < stretches; ++i) {
    if (!used[static_cast<std::size_t>(i)]) continue;
    own += size_of(left, i);
    if (i > 0 && used[static_cast<std::size_t>(i - 1)])
      next += left.segment(i * each, each).dot(left.segment((i - 1) * each, each));
  }
  const double correlation = std::clamp(next / own, 0.0, 0.95);
  s.stderrs = (variance * (1.0 + correlation) / (1.0 - correlation) * inverse.diagonal()).cwiseSqrt();

  std::vector<std::pair<double, double>> missed;  // and of how much
  for (Eigen::Index i = 0; i < stretches; ++i) missed.emplace_back(size_of(left, i), size_of(y, i));
  std::sort(missed.begin(), missed.end());
  double miss = 0.0, of = 1e-30;
  for (std::size_t i = 0; i < static_cast<std::size_t>((1.0 - kWorstStretches) * static_cast<double>(missed.size()));
       ++i)
    miss += missed[i].first, of += missed[i].second;
  s.explained = 1.0 - miss / of;
  return s;
}

// Radii of a vehicle's file are not off against each other by more than a tenth: on a circle, where way and turn are
// the same, noise alone would tell one from the other.
void fit_turns(const std::vector<RunStretch>& stretches, double wheelbase_m, RunFit& fit) {
  constexpr double kUnequal = 0.1;
  const Eigen::Index n = static_cast<Eigen::Index>(stretches.size());
  MatrixXd rows(n, 2);
  VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const RunStretch& s = stretches[static_cast<std::size_t>(i)];
    rows.row(i) << s.rolled_rad, s.rolled_m;
    y[i] = s.turn_rad;
  }
  const Solution found = solved(rows, y, 1, {0.0, kUnequal / wheelbase_m}, std::vector<char>(stretches.size(), 1));
  fit.turn_ratio = found.x[0];
  fit.turn_explained = found.explained;
}

// Of a tracked point at m in a frame turned by h: moved = e^-ih (k rolled + 2 i sin(turn/2) m), as complex numbers.
void fit_way(const std::vector<RunStretch>& stretches, RunFit& fit) {
  const Eigen::Index n = static_cast<Eigen::Index>(stretches.size());
  MatrixXd rows = MatrixXd::Zero(2 * n, 8);
  VectorXd y(2 * n);
  std::vector<char> rolls;
  for (Eigen::Index i = 0; i < n; ++i) {
    const RunStretch& s = stretches[static_cast<std::size_t>(i)];
    const double half = 0.5 * s.turn_rad;
    const double along = s.rolled_m * (std::abs(half) > 1e-6 ? std::sin(half) / half : 1.0),
                 across = 2.0 * std::sin(half);
    const double slip = s.rolled_m / s.duration_s * s.turn_rad, lost = -std::abs(s.turn_rad);
    const double c = s.duration_s * std::cos(s.middle_rad), d = s.duration_s * std::sin(s.middle_rad);
    rows.row(2 * i) << along, 0.0, across, 0.0, 0.0, lost, c, d;
    rows.row(2 * i + 1) << 0.0, along, 0.0, across, slip, 0.0, -d, c;
    y[2 * i] = s.moved.x_m;
    y[2 * i + 1] = s.moved.y_m;
    rolls.push_back(s.rolls());
  }
  const Solution found = solved(rows, y, 2, {0.0, 0.0, 0.0, 0.0, kSlip_s, kLost_m, kCreep_mps, kCreep_mps}, rolls);
  fit.way_explained = found.explained;
  fit.way_ratio = std::hypot(found.x[0], found.x[1]);
  fit.way_stderr = std::max(found.stderrs[0], found.stderrs[1]);
  const double heading_rad = -std::atan2(found.x[1], found.x[0]);
  const Vec2 m = rotated({found.x[3], -found.x[2]}, heading_rad);
  fit.axle_T_tracked = {m.x_m, m.y_m, heading_rad};
  const double place_m = std::max(found.stderrs[2], found.stderrs[3]);
  fit.mounting_stderr = {place_m, place_m, fit.way_stderr / std::max(1e-9, fit.way_ratio)};
}

// Without headings: the median of chord over way, of stretches that hardly turn.
void fit_chords(const std::vector<RunStretch>& stretches, RunFit& fit) {
  std::vector<double> ratios;
  for (const RunStretch& s : stretches)
    if (std::abs(s.rolled_m) > 0.5 * kLongEnough_m && std::abs(s.rolled_rad) < 0.2)
      ratios.push_back(s.chord_m / std::abs(s.rolled_m));
  fit.drives = ratios.size() >= kFewestRunStretches;
  if (!fit.drives) return;
  fit.way_ratio = median(std::move(ratios));
}

}  // namespace

std::optional<RunFit> run_fit(const Recording& recording, const Vehicle& nominal) {
  std::size_t truths = 0, with_heading = 0;
  for (const TruthSample& t : truth_samples(recording)) ++truths, with_heading += t.heading_rad.has_value();
  const bool headings = 2 * with_heading > truths;
  const std::vector<RunStretch> stretches = run_stretches(recording, nominal, headings);
  if (stretches.size() < kFewestRunStretches) return std::nullopt;
  RunFit fit;
  if (!headings) {
    fit_chords(stretches, fit);
    return fit;
  }
  double driven_m = 0.0, turned_rad = 0.0;
  std::size_t roll = 0;
  for (const RunStretch& s : stretches) {
    driven_m += std::abs(s.rolled_m), turned_rad += std::abs(s.rolled_rad);
    roll += s.rolls();
  }
  fit.drives = driven_m > kLeastDriven_m && roll >= kFewestRunStretches;
  fit.turns = turned_rad > kLeastTurned_rad;
  if (fit.turns) fit_turns(stretches, std::get<DifferentialDrive>(nominal.kind).wheelbase_m, fit);
  if (fit.drives) fit_way(stretches, fit);
  return fit;
}

}  // namespace odolab
