#include "core/diagnosis/naming/intervals.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/column_names.h"
#include "core/diagnosis/model/coarse_counts.h"
#include "core/diagnosis/naming/lag_and_delay.h"
#include "core/diagnosis/naming/shape_likelihood.h"
#include "core/diagnosis/naming/shape_search.h"
#include "core/diagnosis/naming/time_at_rest.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A form is never quite that of the world, however long it is looked at: of a value, assumed.
constexpr double kFormErrorOfInterval = 0.01;
constexpr double kErrorOfCounts = 0.2;  // of velocities and accelerations, where they are taken from coarse counts
constexpr double kErrorOfForms = 0.05;  // where machines show it in several forms, of which the nearest was taken

// A time is not known better than to the mean of the truth in which it lies; and a push has a beginning, too.
constexpr double kMoment_s = 0.05;

// What the form itself cannot resolve. A speed above which counts are missed is seen in counts of which some are
// missed.
double resolution_of(const AcceptedEffect& a, int shape) {
  const std::string& unit = a.effect->shapes[static_cast<std::size_t>(shape)].unit;
  if (unit == "rad/s") return std::abs(a.value[0] * a.shape[static_cast<std::size_t>(shape)]);
  return unit == "s" ? kMoment_s : 0.0;
}

// What whole counts leave open of something that happens once: each wheel's way from before to behind it is off by the
// difference of two evenly spread remainders. (Whether it is there at all was asked before: Effect::beyond_counts.)
double rounding_of(const JointModel& joint, const AcceptedEffect& a, int amplitude) {
  if (!a.effect->local || !a.effect->of_one_recording) return 0.0;
  const DifferentialDrive& drive = joint.model.drive;
  const double count_m = count_rad(joint.runs()[static_cast<std::size_t>(a.shape[0])], drive) * 0.5 *
                         (drive.wheel_radius_left_m + drive.wheel_radius_right_m);
  const double of_wheel_m = count_m / std::sqrt(6.0);
  const bool is_turn = a.effect->amplitudes[static_cast<std::size_t>(amplitude)].unit == "rad";
  return is_turn ? of_wheel_m * std::sqrt(2.0) / drive.wheelbase_m : of_wheel_m;
}

// Beside what the recordings say of a place or a threshold: rims are not sharp, and speeds are known as smoothed.
double known_to(const AcceptedEffect& a, int shape) {
  constexpr double kPlace_m = 0.01, kOfThreshold = 0.05;
  const std::string& unit = a.effect->shapes[static_cast<std::size_t>(shape)].unit;
  if (unit == "rad/s") return kOfThreshold * std::abs(a.shape[static_cast<std::size_t>(shape)]);
  if (unit != "m") return 0.0;
  return a.effect->place_known_to_m ? a.effect->place_known_to_m(a.shape) : kPlace_m;
}

// The derivative of the motion by the free shapes, over the width within which they are known.
Effect by_shape(const AcceptedEffect& a, const std::vector<int>& free, const MatrixXd& covariance) {
  Effect e;
  e.name = a.effect->name;
  e.component = a.effect->component;
  e.of_one_recording = a.effect->of_one_recording;
  e.local = a.effect->local;
  e.amplitudes.resize(free.size());
  const auto motions = a.effect->motions;
  e.motions = [a, free, covariance, motions](const DriveView& view, const std::vector<double>&) {
    std::vector<Motions> out(free.size(), Motions(view.steps.size()));
    for (std::size_t k = 0; k < free.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double by = std::sqrt(covariance(i, i));
      if (by <= 0.0) continue;
      for (double side : {-1.0, 1.0}) {
        std::vector<double> shape = a.shape;
        shape[free[k]] += side * by;
        const std::vector<Motions> there = motions(view, shape);
        for (std::size_t j = 0; j < there.size(); ++j) there[j].add_to(out[k], side * a.value[j] / (2.0 * by));
      }
    }
    return out;
  };
  return e;
}

// By how much an accepted effect's amplitudes would be others in other forms, squared, each form weighed by its
// likelihood.
VectorXd between_forms(const JointModel& joint, std::size_t accepted, double inflation) {
  const AcceptedEffect& a = joint.accepted[accepted];
  const auto n = static_cast<Eigen::Index>(a.value.size());
  VectorXd sum = VectorXd::Zero(n);
  if (a.effect->forms.size() < 2 || a.is_held || a.effect->local) return sum;
  std::vector<CandidateTest> of_form;
  for (std::size_t form = 0; form < a.effect->forms.size(); ++form)
    of_form.push_back(tested_in_form(joint, accepted, form));
  double best = 0.0, all = 0.0;
  for (const CandidateTest& t : of_form) best = std::max(best, t.statistic);
  const CandidateTest& own = of_form[static_cast<std::size_t>(a.shape.back())];
  for (const CandidateTest& t : of_form) {
    if (t.value.size() != a.value.size() || own.value.size() != a.value.size()) continue;
    const double weight = std::exp(0.5 * (t.statistic - best) / inflation);
    all += weight;
    for (std::size_t k = 0; k < own.value.size(); ++k) {
      const double to_own_side = a.effect->forms_have_sides && t.value[k] * own.value[k] < 0.0 ? -1.0 : 1.0;
      sum(static_cast<Eigen::Index>(k)) += weight * std::pow(to_own_side * t.value[k] - own.value[k], 2);
    }
  }
  return all > 0.0 ? VectorXd(sum / all) : sum;
}

// What an amplitude may be off beyond what the recordings say, calibration is off with it, as both go together:
// d theta = C_ta C_aa^-1 d a.
void add_to_calibration(const MatrixXd& together, int first, const VectorXd& of_amplitudes, MatrixXd& columns) {
  const Eigen::Index n = of_amplitudes.size(), calibrated = std::min<Eigen::Index>(column::truth_clock, columns.rows());
  const MatrixXd of_own = together.block(first, first, n, n);
  const VectorXd size = of_own.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = size.asDiagonal() * of_own * size.asDiagonal();
  const MatrixXd moves = (size.asDiagonal() * scaled.completeOrthogonalDecomposition().solve(
                                                  size.asDiagonal() * together.block(first, 0, n, calibrated)))
                             .transpose();
  columns.topLeftCorner(calibrated, calibrated) += moves * of_amplitudes.asDiagonal() * moves.transpose();
}

}  // namespace

double Intervals::stderr_of_nuisance(int c) const { return std::sqrt(std::max(0.0, columns(c, c))); }

SharedClock Intervals::shared_clock(const JointModel& joint) const {
  const auto runs = static_cast<Eigen::Index>(joint.clock_s.size());
  return odolab::shared_clock(joint.clock_s, columns.block(column::truth_clock, column::truth_clock, runs, runs));
}

std::vector<int> free_shapes(const Effect& effect) {
  std::vector<int> free;
  if (effect.shape_follows_amplitude) return free;
  for (std::size_t k = 0; k < effect.shapes.size(); ++k)
    if (is_estimated(effect.shapes[k]) && !is_only_bounded(effect.shapes[k])) free.push_back(static_cast<int>(k));
  return free;
}

Intervals refined(JointModel& joint, const std::vector<double>& inflation) {
  const std::size_t count = joint.accepted.size();
  std::vector<MatrixXd> of_shape(count), of_amplitudes(count);
  bool moved = false;
  for (std::size_t a = 0; a < count; ++a) {
    if (free_shapes(*joint.accepted[a].effect).empty() || joint.accepted[a].shape.empty()) continue;
    const ShapeLikelihood shape = shape_likelihood(joint, static_cast<int>(a), inflation[a]);
    of_shape[a] = shape.covariance;
    of_amplitudes[a] = shape.of_amplitudes;
    const bool mean_is_good = shape.lost < 2.0 * inflation[a];  // not so between two summits
    joint.accepted[a].shape = mean_is_good ? shape.mean : shape.best;
    const std::vector<int> free = free_shapes(*joint.accepted[a].effect);
    for (std::size_t k = 0; k < free.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      of_shape[a](i, i) += std::pow(resolution_of(joint.accepted[a], free[k]), 2);
      if (!joint.accepted[a].effect->happens_at_rest) continue;
      const UncertainTime when =
          time_with_rests(joint, static_cast<int>(a), free[k],
                          {joint.accepted[a].shape[free[k]], std::sqrt(of_shape[a](i, i))}, inflation[a]);
      joint.accepted[a].shape[free[k]] = when.at_s;
      of_shape[a](i, i) = when.stderr_s * when.stderr_s;
    }
    moved = true;
  }
  if (moved) joint.fit(3);

  Intervals out;
  const VectorXd wider = joint.inflation_of_columns().cwiseSqrt();
  out.columns = wider.asDiagonal() * joint.covariance() * wider.asDiagonal();
  for (std::size_t a = 0; a < count; ++a) {
    if (!joint.accepted[a].is_held) continue;
    const Eigen::Index c = joint.first_column(static_cast<int>(a));
    const double larger = std::sqrt(inflation[a] * variance_of_held(joint, a) / std::max(out.columns(c, c), 1e-300));
    out.columns.row(c) *= larger;
    out.columns.col(c) *= larger;
  }
  const MatrixXd at_these_shapes = out.columns;
  std::vector<MatrixXd> moves(count);  // the columns by the shapes
  for (std::size_t a = 0; a < count; ++a) {
    if (of_shape[a].size() == 0) continue;
    const Effect derivative = by_shape(joint.accepted[a], free_shapes(*joint.accepted[a].effect), of_shape[a]);
    moves[a] = -joint.absorbed(joint.columns_of(derivative, joint.accepted[a].shape));
    if (moves[a].cols() == of_shape[a].rows()) out.columns += moves[a] * of_shape[a] * moves[a].transpose();
  }
  const bool are_coarse = counts_are_coarse(joint);
  for (std::size_t a = 0; a < count; ++a) {
    const int first = joint.first_column(static_cast<int>(a)), n = static_cast<int>(joint.accepted[a].value.size());
    const int m = static_cast<int>(of_shape[a].rows());
    MatrixXd block = MatrixXd::Zero(n + m, n + m);
    block.topLeftCorner(n, n) = out.columns.block(first, first, n, n);
    // A patch may be small and slippery or large and less so: no derivative by its radius says how much.
    const bool is_patch = m > 0 && is_a_patch(*joint.accepted[a].effect);
    if (is_patch) block.topLeftCorner(n, n) = at_these_shapes.block(first, first, n, n) + of_amplitudes[a];
    double square = 0.0;
    for (double v : joint.accepted[a].value) square += v * v / n;
    const Effect& effect = *joint.accepted[a].effect;
    const double form = are_coarse && !effect.local                            ? kErrorOfCounts
                        : effect.forms.size() > 1 && !effect.forms_come_to_one ? kErrorOfForms
                                                                               : kFormErrorOfInterval;
    VectorXd of_form = VectorXd::Constant(n, form * form * square);
    if (effect.forms_come_to_one)
      for (int k = 0; k < n; ++k) of_form(k) = std::pow(form * joint.accepted[a].value[static_cast<std::size_t>(k)], 2);
    block.topLeftCorner(n, n) += of_form.asDiagonal();
    if (m > 0) {
      block.bottomRightCorner(m, m) = of_shape[a];
      if (moves[a].cols() == m && !is_patch) {
        block.topRightCorner(n, m) = moves[a].middleRows(first, n) * of_shape[a];
        block.bottomLeftCorner(m, n) = block.topRightCorner(n, m).transpose();
      }
    }
    // Whether there is a patch at all was asked of all places and sizes together; and whether counts are lost over a
    // band of speeds, of all speeds: a little from one on says as much as more from a higher one on.
    const double near = effect.near_its_limit ? effect.near_its_limit(joint.accepted[a].shape, joint.views()) : 0.0;
    const bool is_band = effect.near_its_limit && near == 0.0;
    MatrixXd known = block.topLeftCorner(n, n);
    if (is_patch || is_band) known = at_these_shapes.block(first, first, n, n);
    const VectorXd value = Eigen::Map<const VectorXd>(joint.accepted[a].value.data(), n);
    out.from_nothing.push_back(value.dot(known.ldlt().solve(value)));
    VectorXd of_forms = between_forms(joint, a, inflation[a]);
    of_forms.array() += square * near * near;
    for (int k = 0; k < n; ++k) block(k, k) += std::pow(rounding_of(joint, joint.accepted[a], k), 2) + of_forms(k);
    out.of_effect.push_back(block);
    add_to_calibration(at_these_shapes, first, of_form + of_forms, out.columns);
  }
  return out;
}

std::vector<FoundParameter> parameters_of(const AcceptedEffect& a, const MatrixXd& covariance,
                                          const std::vector<DriveView>& views) {
  const auto n = static_cast<Eigen::Index>(a.value.size());
  const auto in_words = [&](const std::vector<double>& value) {
    if (a.effect->to_parameters) return a.effect->to_parameters(value, std::vector<double>(value.size(), 0.0));
    std::vector<FoundParameter> out;
    for (std::size_t k = 0; k < value.size(); ++k)
      out.push_back({a.effect->amplitudes[k].name, value[k], 0.0, a.effect->amplitudes[k].unit});
    return out;
  };
  std::vector<FoundParameter> out = in_words(a.value);
  MatrixXd by(out.size(), n);  // derivative of the parameters, by differences
  for (Eigen::Index k = 0; k < n; ++k) {
    const double step = std::max(0.01 * std::sqrt(covariance(k, k)), 1e-12);
    std::vector<double> up = a.value, down = a.value;
    up[static_cast<std::size_t>(k)] += step;
    down[static_cast<std::size_t>(k)] -= step;
    const std::vector<FoundParameter> high = in_words(up), low = in_words(down);
    for (std::size_t j = 0; j < out.size(); ++j) {
      const double change = high[j].value - low[j].value;
      by(static_cast<Eigen::Index>(j), k) = (out[j].unit == "rad" ? wrapped(change) : change) / (2.0 * step);
    }
  }
  const MatrixXd cov = by * covariance.topLeftCorner(n, n) * by.transpose();
  for (std::size_t j = 0; j < out.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    out[j].stderr_value = std::sqrt(std::max(0.0, cov(i, i)));
  }
  const double at_mps = a.effect->stated_at_mps ? a.effect->stated_at_mps(a.shape, views) : 0.0;
  if (at_mps > 0.0) {
    for (FoundParameter& p : out) p.value *= at_mps, p.stderr_value *= at_mps;
    out.push_back({kStatedAt, at_mps, 0.0, "m/s"});
  }
  const double times = a.effect->shapes_read_as ? a.effect->shapes_read_as(a.value) : 1.0;
  Eigen::Index k = n;
  for (int s : free_shapes(*a.effect)) {
    const double se = k < covariance.rows() ? std::sqrt(std::max(0.0, covariance(k, k))) : 0.0;
    out.push_back({a.effect->shapes[s].name, times * a.shape[s], times * std::hypot(se, known_to(a, s)),
                   a.effect->shapes[s].unit});
    ++k;
  }
  for (std::size_t k = 0; k < a.effect->shapes.size(); ++k) {
    const Effect::Amplitude& s = a.effect->shapes[k];
    const bool is_start_of_session =
        s.name == kSessionStart && effects::drifts_through_the_session(static_cast<int>(std::lround(a.shape.back())));
    if (is_only_bounded(s) || is_start_of_session) out.push_back({s.name, a.shape[k], 0.0, s.unit});
  }
  return out;
}

LeastSquaresCalibration calibration_with(const JointModel& joint, const Intervals& intervals,
                                         const LeastSquaresCalibration& alone, const Vehicle& nominal) {
  LeastSquaresCalibration out = alone;
  out.vehicle = nominal;
  out.vehicle.kind = joint.model.drive;
  out.vehicle.truth = joint.model.truth;
  out.time_offset_s = joint.clock_s;
  const SharedClock clock = intervals.shared_clock(joint);
  out.vehicle.truth.time_offset_s = clock.offset_s;
  out.noise = joint.noise_as_recorded();
  const DifferentialDrive& drive = joint.model.drive;
  const Pose& tracked = out.vehicle.truth.axle_T_tracked;
  const double now[column::first_extra] = {drive.wheel_radius_left_m,
                                           drive.wheel_radius_right_m,
                                           drive.wheelbase_m,
                                           tracked.x_m,
                                           tracked.y_m,
                                           tracked.heading_rad,
                                           clock.offset_s};
  std::vector<VectorXd> rows;  // the determined parameters by the model's columns
  for (ParameterEstimate& p : out.parameters) {
    const int c = column::of_key(p.name);
    if (c < 0 || !p.determined) continue;
    const bool is_clock = c == column::truth_clock;
    VectorXd row = VectorXd::Zero(intervals.columns.rows());
    if (is_clock)
      row.segment(c, clock.weights.size()) = clock.weights;
    else
      row(c) = 1.0;
    p.value = now[c];
    p.stderr_value = is_clock ? clock.stderr_s : std::sqrt(std::max(0.0, row.dot(intervals.columns * row)));
    rows.push_back(row);
  }
  out.covariance.clear();
  for (const VectorXd& a : rows)
    for (const VectorXd& b : rows) out.covariance.push_back(a.dot(intervals.columns * b));
  return out;
}

}  // namespace odolab
