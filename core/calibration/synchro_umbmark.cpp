#include "core/calibration/synchro_umbmark.h"

#include <Eigen/Dense>

#include "core/odometry/synchro_step.h"

namespace odolab {

namespace {

constexpr double kCornerTurn_rad = 0.5 * kPi;
constexpr int kStepsOfASide = 40;  // chords at the middle heading: the error of an arc of 0.1 rad is below 1e-6 of it

// A robot that turns by 90 degrees less a where its belief says 90, and whose base turns by so much more.
SynchroDrive with_errors(const SynchroDrive& nominal, const Eigen::Vector4d& e) {
  SynchroDrive actual = nominal;
  actual.steering_ratio = nominal.steering_ratio * kCornerTurn_rad / (kCornerTurn_rad - e(0));
  actual.base_turn_rad_per_m += e(1);
  actual.base_turn_cos_rad_per_m += e(2);
  actual.base_turn_sin_rad_per_m += e(3);
  return actual;
}

Eigen::Vector4d synchro_predicted(const SynchroDrive& nominal, const Eigen::Vector4d& errors, double side_m) {
  const SynchroDrive actual = with_errors(nominal, errors);
  const ReturnError cw = synchro_square_return_error(actual, nominal, side_m, true);
  const ReturnError ccw = synchro_square_return_error(actual, nominal, side_m, false);
  return {cw.x_m, cw.y_m, ccw.x_m, ccw.y_m};
}

Eigen::Matrix4d synchro_jacobian(const SynchroDrive& nominal, const Eigen::Vector4d& errors, double side_m) {
  const double h = 1e-6;  // central differences, as for the differential drive
  Eigen::Matrix4d j;
  for (int k = 0; k < 4; ++k) {
    Eigen::Vector4d up = errors, down = errors;
    up(k) += h;
    down(k) -= h;
    j.col(k) = (synchro_predicted(nominal, up, side_m) - synchro_predicted(nominal, down, side_m)) / (2.0 * h);
  }
  return j;
}

// Covariance of the mean of one direction's return positions, of which there are two or more.
Eigen::Matrix2d of_centre(const std::vector<ReturnError>& runs, const Cluster& cluster) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const ReturnError& e : runs) {
    const Eigen::Vector2d off(e.x_m - cluster.centre_of_gravity.x_m, e.y_m - cluster.centre_of_gravity.y_m);
    sum += off * off.transpose();
  }
  const double n = static_cast<double>(runs.size());
  return sum / ((n - 1.0) * n);
}

}  // namespace

ReturnError synchro_square_return_error(const SynchroDrive& actual, const SynchroDrive& believed, double side_m,
                                        bool clockwise) {
  SynchroPose real, thought;
  const double way = clockwise ? -1.0 : 1.0;
  // What both motors do so that the belief moves like this.
  const auto move = [&](double travel_m, double turn_rad) {
    double steered_rad = turn_rad;  // less what the base turns by itself, which the driver steers against
    for (int i = 0; i < 3; ++i) {
      const double direction_rad = thought.pose.heading_rad - thought.base_heading_rad + 0.5 * steered_rad;
      steered_rad = (turn_rad - travel_m * (believed.base_turn_rad_per_m +
                                            believed.base_turn_cos_rad_per_m * std::cos(direction_rad) +
                                            believed.base_turn_sin_rad_per_m * std::sin(direction_rad))) /
                    (1.0 + believed.base_turn_rad_per_steering_rad);
    }
    const double steering_rad = steered_rad * believed.steering_ratio;
    const double wheel_rad = travel_m / believed.wheel_radius_m + believed.wheel_rad_per_steering_rad * steered_rad;
    thought = dead_reckoned(thought, wheel_rad, steering_rad, believed);
    real = dead_reckoned(real, wheel_rad, steering_rad, actual);
  };
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < kStepsOfASide; ++i) move(side_m / kStepsOfASide, 0.0);
    move(0.0, way * kCornerTurn_rad);
  }
  return {real.pose.x_m - thought.pose.x_m, real.pose.y_m - thought.pose.y_m,
          real.pose.heading_rad - thought.pose.heading_rad};
}

std::optional<SynchroCalibration> calibrate_synchro(const UmbmarkRuns& runs, const SynchroDrive& nominal) {
  const std::optional<UmbmarkMeasure> measure = measure_umbmark(runs);
  if (!measure || !(runs.side_m > 0.0) || !problems_in(nominal).empty()) return std::nullopt;
  const Vec2 cw = measure->clockwise.centre_of_gravity, ccw = measure->counter_clockwise.centre_of_gravity;
  const Eigen::Vector4d centres(cw.x_m, cw.y_m, ccw.x_m, ccw.y_m);
  const double side_m = runs.side_m;

  const double corner = (cw.x_m + ccw.x_m) / (-4.0 * side_m);  // Eqs. 1 and 2
  const double steady = (cw.y_m + ccw.y_m) / (-4.0 * side_m * side_m);
  Eigen::Vector4d errors(corner, steady, 0.5 * (cw.x_m - ccw.x_m) / (side_m * side_m) + 2.0 * steady,
                         0.5 * (cw.y_m - ccw.y_m) / (side_m * side_m) + 2.0 * corner / side_m);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector4d step = synchro_jacobian(nominal, errors, side_m)
                                     .colPivHouseholderQr()
                                     .solve(centres - synchro_predicted(nominal, errors, side_m));
    errors = (errors + step).cwiseMax(-1.0).cwiseMin(1.0);
    if (step.norm() < 1e-14) break;
  }

  SynchroCalibration c;
  c.corner_error_rad = errors(0);
  c.base_turn_rad_per_m = errors(1);
  c.base_turn_cos_rad_per_m = errors(2);
  c.base_turn_sin_rad_per_m = errors(3);
  c.corrected = with_errors(nominal, errors);
  if (runs.clockwise.size() < 2 || runs.counter_clockwise.size() < 2) return c;
  Eigen::Matrix4d of_centres = Eigen::Matrix4d::Zero();
  of_centres.topLeftCorner<2, 2>() = of_centre(runs.clockwise, measure->clockwise);
  of_centres.bottomRightCorner<2, 2>() = of_centre(runs.counter_clockwise, measure->counter_clockwise);
  const Eigen::Matrix4d inverse = synchro_jacobian(nominal, errors, side_m).inverse();
  const Eigen::Matrix4d of_errors = inverse * of_centres * inverse.transpose();
  c.standard_errors.emplace();
  for (int k = 0; k < 4; ++k) (*c.standard_errors)[static_cast<std::size_t>(k)] = std::sqrt(of_errors(k, k));
  return c;
}

}  // namespace odolab
