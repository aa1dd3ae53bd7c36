#include "core/calibration/umbmark.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace odolab {

namespace {

using Errors = std::vector<ReturnError>;

constexpr double kCorner = 0.5 * kPi;

Cluster cluster_of(const Errors& runs) {
  const double n = static_cast<double>(runs.size());
  Cluster c;
  for (const ReturnError& e : runs) {
    c.centre_of_gravity = c.centre_of_gravity + Vec2{e.x_m / n, e.y_m / n};  // Eq. 3.2
    c.mean_heading_rad += e.heading_rad / n;                                 // Eq. 3.6
  }
  c.distance_m = length(c.centre_of_gravity);  // Eq. 3.3
  if (runs.size() < 2) return c;
  double squares = 0.0;
  for (const ReturnError& e : runs) {
    const Vec2 off = Vec2{e.x_m, e.y_m} - c.centre_of_gravity;
    squares += dot(off, off);
  }
  c.spread_m = std::sqrt(squares / (n - 1.0));
  c.standard_error_m = c.spread_m / std::sqrt(n);
  return c;
}

// Covariance of one run's return position, pooled over both directions. The path of the other direction is the mirror
// image, so y changes its sign there.
Eigen::Matrix2d pooled_covariance(const UmbmarkRuns& runs, const UmbmarkMeasure& measure) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  const auto add = [&](const Errors& errors, const Cluster& cluster, double mirror) {
    for (const ReturnError& e : errors) {
      const Eigen::Vector2d off(e.x_m - cluster.centre_of_gravity.x_m,
                                mirror * (e.y_m - cluster.centre_of_gravity.y_m));
      sum += off * off.transpose();
    }
  };
  add(runs.clockwise, measure.clockwise, 1.0);
  add(runs.counter_clockwise, measure.counter_clockwise, -1.0);
  const double freedom = static_cast<double>(runs.clockwise.size() + runs.counter_clockwise.size()) - 2.0;
  return freedom > 0.0 ? Eigen::Matrix2d(sum / freedom) : Eigen::Matrix2d::Zero();
}

// The true wheelbase of a robot that turns by 90 degrees minus alpha where its nominal wheelbase says 90: Eq. 6.28.
double wheelbase_ratio(double alpha_rad) { return kCorner / (kCorner - alpha_rad); }

// All four coordinates of the two centres as alpha and beta predict them.
Eigen::Vector4d predicted(const TypeErrors& e, double side_m, double nominal_wheelbase_m) {
  const double wheelbase_m = nominal_wheelbase_m * wheelbase_ratio(e.alpha_rad);
  const ReturnError cw = square_return_error(e, side_m, true, wheelbase_m);
  const ReturnError ccw = square_return_error(e, side_m, false, wheelbase_m);
  return {cw.x_m, cw.y_m, ccw.x_m, ccw.y_m};
}

Eigen::Matrix<double, 4, 2> jacobian(const TypeErrors& e, double side_m, double nominal_wheelbase_m) {
  const double h = 1e-6;  // central differences: error of order h^2 and of rounding / h, both below 1e-9 m per rad
  const auto at = [&](double da, double db) {
    return predicted({e.alpha_rad + da, e.beta_rad + db}, side_m, nominal_wheelbase_m);
  };
  Eigen::Matrix<double, 4, 2> j;
  j.col(0) = (at(h, 0.0) - at(-h, 0.0)) / (2.0 * h);
  j.col(1) = (at(0.0, h) - at(0.0, -h)) / (2.0 * h);
  return j;
}

TypeErrors kept_physical(TypeErrors e) {
  return {std::clamp(e.alpha_rad, -1.0, 1.0), std::clamp(e.beta_rad, -1.0, 1.0)};
}

}  // namespace

ReturnError square_return_error(const TypeErrors& errors, double side_m, bool clockwise, double wheelbase_m) {
  const double way = clockwise ? -1.0 : 1.0;
  const double beta = errors.beta_rad;
  const double chord_m = std::abs(beta) < 1e-9 ? side_m : side_m * std::sin(0.5 * beta) / (0.5 * beta);
  const double turn_rad = way * (kCorner - errors.alpha_rad);
  // The right wheel rolls (1 + e), the left one (1 - e) of what the robot believes, e = beta b / 2L; in a turn they
  // roll against each other, and the centre moves by e times the way of one wheel.
  const double shift_arc_m = 0.5 * beta * wheelbase_m / side_m * 0.5 * wheelbase_m * turn_rad;
  const double shift_m = shift_arc_m * std::sin(0.5 * turn_rad) / (0.5 * turn_rad);
  Pose pose;
  for (int side = 0; side < 4; ++side) {
    pose = advanced(pose, chord_m, beta);
    pose = advanced(pose, shift_m, turn_rad);
  }
  return {pose.x_m, pose.y_m, wrapped(pose.heading_rad)};  // the robot believes to stand at 0, 0, 0
}

std::optional<UmbmarkMeasure> measure_umbmark(const UmbmarkRuns& runs) {
  if (runs.clockwise.empty() || runs.counter_clockwise.empty()) return std::nullopt;
  UmbmarkMeasure m;
  m.clockwise = cluster_of(runs.clockwise);
  m.counter_clockwise = cluster_of(runs.counter_clockwise);
  m.largest_systematic_error_m = std::max(m.clockwise.distance_m, m.counter_clockwise.distance_m);  // Eq. 3.4
  m.spread_m = std::sqrt(pooled_covariance(runs, m).trace());
  const bool cw_is_worse = m.clockwise.distance_m >= m.counter_clockwise.distance_m;
  const double n = static_cast<double>(cw_is_worse ? runs.clockwise.size() : runs.counter_clockwise.size());
  m.standard_error_m = m.spread_m / std::sqrt(n);
  m.worth_compensating = m.spread_m == 0.0 || m.largest_systematic_error_m > 3.0 * m.standard_error_m;
  return m;
}

std::optional<UmbmarkCalibration> calibrate_umbmark(const UmbmarkRuns& runs, const DifferentialDrive& nominal) {
  const std::optional<UmbmarkMeasure> measure = measure_umbmark(runs);
  if (!measure || !(runs.side_m > 0.0) || !problems_in(nominal).empty()) return std::nullopt;
  const Vec2 cw = measure->clockwise.centre_of_gravity, ccw = measure->counter_clockwise.centre_of_gravity;
  const double four_sides_m = 4.0 * runs.side_m;

  UmbmarkCalibration c;
  c.from_x = {(cw.x_m + ccw.x_m) / -four_sides_m, (cw.x_m - ccw.x_m) / -four_sides_m};  // Eqs. 6.26a, 6.22a
  c.from_y = {(cw.y_m - ccw.y_m) / -four_sides_m, (cw.y_m + ccw.y_m) / -four_sides_m};  // Eqs. 6.26b, 6.22b
  c.printed = {0.5 * (c.from_x.alpha_rad + c.from_y.alpha_rad), 0.5 * (c.from_x.beta_rad + c.from_y.beta_rad)};

  const Eigen::Vector4d centres(cw.x_m, cw.y_m, ccw.x_m, ccw.y_m);
  c.exact = kept_physical(c.printed);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector4d left = centres - predicted(c.exact, runs.side_m, nominal.wheelbase_m);
    const Eigen::Vector2d step = jacobian(c.exact, runs.side_m, nominal.wheelbase_m).colPivHouseholderQr().solve(left);
    c.exact = kept_physical({c.exact.alpha_rad + step(0), c.exact.beta_rad + step(1)});
    if (step.norm() < 1e-14) break;
  }
  c.residual_m = (centres - predicted(c.exact, runs.side_m, nominal.wheelbase_m)).norm() / 2.0;

  c.wheelbase_ratio = wheelbase_ratio(c.exact.alpha_rad);  // Eq. 6.29
  const double wheelbase_m = nominal.wheelbase_m * c.wheelbase_ratio;
  c.curvature_radius_m =
      c.exact.beta_rad == 0.0 ? std::numeric_limits<double>::infinity() : runs.side_m / c.exact.beta_rad;
  const double half_over_radius = 0.5 * wheelbase_m / c.curvature_radius_m;
  c.wheel_diameter_ratio = (1.0 + half_over_radius) / (1.0 - half_over_radius);  // Eq. 6.24

  // Eqs. 6.31 to 6.34. Where the nominal wheels are unequal already, the ratio found is on top of theirs.
  const double mean_radius_m = 0.5 * (nominal.wheel_radius_left_m + nominal.wheel_radius_right_m);
  const double ratio = c.wheel_diameter_ratio * nominal.wheel_radius_right_m / nominal.wheel_radius_left_m;
  c.corrected = nominal;
  c.corrected.wheel_radius_left_m = mean_radius_m * 2.0 / (ratio + 1.0);
  c.corrected.wheel_radius_right_m = mean_radius_m * 2.0 / (1.0 / ratio + 1.0);
  c.corrected.wheelbase_m = wheelbase_m;  // Eq. 6.28
  c.left_factor = c.corrected.wheel_radius_left_m / nominal.wheel_radius_left_m;
  c.right_factor = c.corrected.wheel_radius_right_m / nominal.wheel_radius_right_m;

  // The spread of the runs carried through the same least squares.
  const Eigen::Matrix2d of_a_run = pooled_covariance(runs, *measure);
  const Eigen::DiagonalMatrix<double, 2> mirror(1.0, -1.0);
  Eigen::Matrix4d of_centres = Eigen::Matrix4d::Zero();
  of_centres.topLeftCorner<2, 2>() = of_a_run / static_cast<double>(runs.clockwise.size());
  of_centres.bottomRightCorner<2, 2>() =
      mirror * of_a_run * mirror / static_cast<double>(runs.counter_clockwise.size());
  const Eigen::Matrix<double, 4, 2> j = jacobian(c.exact, runs.side_m, nominal.wheelbase_m);
  const Eigen::Matrix<double, 2, 4> to_errors = (j.transpose() * j).inverse() * j.transpose();
  const Eigen::Matrix2d of_errors = to_errors * of_centres * to_errors.transpose();
  c.wheelbase_ratio_stderr = std::sqrt(of_errors(0, 0)) * c.wheelbase_ratio / (kCorner - c.exact.alpha_rad);
  c.wheel_diameter_ratio_stderr = std::sqrt(of_errors(1, 1)) * wheelbase_m / runs.side_m;
  return c;
}

std::optional<OneDirectionCalibration> calibrate_one_direction(const UmbmarkRuns& runs, bool clockwise,
                                                               const DifferentialDrive& nominal) {
  const std::optional<UmbmarkCalibration> both = calibrate_umbmark(runs, nominal);
  if (!both) return std::nullopt;
  const Vec2 centre = cluster_of(clockwise ? runs.clockwise : runs.counter_clockwise).centre_of_gravity;
  const auto off = [&](double alpha) {
    const ReturnError e = square_return_error({alpha, 0.0}, runs.side_m, clockwise, nominal.wheelbase_m);
    return Vec2{centre.x_m - e.x_m, centre.y_m - e.y_m};
  };
  double alpha = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double h = 1e-6;
    const Vec2 slope = (0.5 / h) * (off(alpha + h) - off(alpha - h));
    const double step = -dot(slope, off(alpha)) / dot(slope, slope);
    alpha = std::clamp(alpha + step, -1.0, 1.0);
    if (std::abs(step) < 1e-13) break;
  }
  OneDirectionCalibration one;
  one.wheelbase_ratio = wheelbase_ratio(alpha);
  one.predicted_error_this_way_m = length(off(alpha));
  // With its new wheelbase the robot turns more than it did by that factor.
  const double turned_rad = (kCorner - both->exact.alpha_rad) * one.wheelbase_ratio;
  const ReturnError other = square_return_error({kCorner - turned_rad, both->exact.beta_rad}, runs.side_m, !clockwise,
                                                both->corrected.wheelbase_m);
  one.predicted_error_other_way_m = std::hypot(other.x_m, other.y_m);
  return one;
}

std::optional<ExtendedUmbmark> measure_extended_umbmark(const UmbmarkRuns& smooth, const UmbmarkRuns& with_bumps) {
  for (const Errors* errors :
       {&smooth.clockwise, &smooth.counter_clockwise, &with_bumps.clockwise, &with_bumps.counter_clockwise})
    if (errors->empty()) return std::nullopt;
  ExtendedUmbmark result;
  result.systematic_bias_clockwise_rad = cluster_of(smooth.clockwise).mean_heading_rad;                  // Eq. 3.6
  result.systematic_bias_counter_clockwise_rad = cluster_of(smooth.counter_clockwise).mean_heading_rad;  //
  double sum = 0.0;
  for (const ReturnError& e : with_bumps.clockwise)
    sum += std::abs(e.heading_rad - result.systematic_bias_clockwise_rad);
  for (const ReturnError& e : with_bumps.counter_clockwise)
    sum += std::abs(e.heading_rad - result.systematic_bias_counter_clockwise_rad);
  const std::size_t runs = with_bumps.clockwise.size() + with_bumps.counter_clockwise.size();
  result.mean_absolute_heading_error_rad = sum / static_cast<double>(runs);  // Eq. 3.5, see README
  return result;
}

}  // namespace odolab
