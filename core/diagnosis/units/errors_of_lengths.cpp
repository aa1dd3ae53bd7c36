#include "core/diagnosis/units/errors_of_lengths.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/calibration/column_names.h"
#include "core/calibration/innovations.h"
#include "core/diagnosis/units/axle_put_off.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Length = std::function<double&(Vehicle&)>;

ExtraColumn moved_by(const AxlePutOff& off, const std::vector<DriveStep>& steps) {
  ExtraColumn column;
  for (const DriveStep& s : steps)
    column.per_step.push_back(off.moved(s.time_s, s.duration_s, 0.5 * (s.left_m + s.right_m), s.turn_rad));
  return column;
}

// Of all recordings, with the clock of each fitted beside the rest.
MatrixXd information_of(const std::vector<Recording>& own, const std::vector<std::vector<UnitSample>>& samples,
                        const Vehicle& vehicle, std::size_t unit, const UncertainLengths& lengths,
                        const LeastSquaresCalibration& calibration) {
  const auto& drive = std::get<DifferentialDrive>(calibration.vehicle.kind);
  const int n = column::first_extra + static_cast<int>(lengths.of.size());
  std::vector<MatrixXd> parts(own.size(), MatrixXd::Zero(n, n));
  parallel_for(static_cast<int>(own.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    Vehicle as_timed = calibration.vehicle;
    as_timed.truth.time_offset_s = calibration.time_offset_s[r];
    Result<InnovationRun> run = innovation_run(own[r], as_timed);
    if (!run || samples[r].size() < 3) return;
    const std::vector<DriveStep> steps = drive_steps(*run, drive);
    for (const Length& length : lengths.of)
      run->extra.push_back(moved_by(axle_put_off(samples[r], vehicle, unit,
                                                 [&](Vehicle& v, std::vector<double>&, double by) { length(v) += by; }),
                                    steps));
    const InnovationModel model{drive, as_timed.truth, as_large_as_any_real(calibration.noise)};
    const InnovationSums sums = filtered(*run, summed_up(*run, model), model);
    MatrixXd all = Eigen::Map<const MatrixXd>(sums.information.data(), n, n);
    const Eigen::VectorXd by_clock = all.col(column::truth_clock);
    const double of_clock = by_clock[column::truth_clock];
    if (of_clock > 0.0) all -= by_clock * by_clock.transpose() / of_clock;
    parts[r] = all;
  });
  MatrixXd sum = MatrixXd::Zero(n, n);
  for (const MatrixXd& part : parts) sum += part;
  return sum;
}

// By the calibration's name for it; empty where it is no such.
Length place_of_truth(const std::string& name) {
  switch (column::of_key(name)) {
    case column::mounting_x:
      return [](Vehicle& v) -> double& { return v.truth.axle_T_tracked.x_m; };
    case column::mounting_y:
      return [](Vehicle& v) -> double& { return v.truth.axle_T_tracked.y_m; };
    case column::mounting_heading:
      return [](Vehicle& v) -> double& { return v.truth.axle_T_tracked.heading_rad; };
    default:
      return {};
  }
}

}  // namespace

UncertainLengths uncertain_lengths(const GeometryFit& geometry, const LeastSquaresCalibration* carrying) {
  UncertainLengths lengths;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = 0; k < geometry.covariance.rows(); ++k) {
    const JointEstimate& e = geometry.joints[static_cast<std::size_t>(k)];
    if (!e.determined) continue;
    rows.push_back(k);
    lengths.of.push_back(e.parameter.of);
  }
  std::vector<double> variances;
  if (carrying)
    for (const ParameterEstimate& p : carrying->parameters)
      if (const Length place = place_of_truth(p.name); place && p.determined) {
        lengths.of.push_back(place);
        variances.push_back(p.stderr_value * p.stderr_value);
      }
  const auto n = static_cast<Eigen::Index>(rows.size()), of_truth = static_cast<Eigen::Index>(variances.size());
  lengths.covariance = MatrixXd::Zero(n + of_truth, n + of_truth);
  lengths.covariance.topLeftCorner(n, n) = geometry.covariance(rows, rows);
  lengths.covariance.bottomRightCorner(of_truth, of_truth).diagonal() =
      Eigen::Map<const Eigen::VectorXd>(variances.data(), of_truth);
  return lengths;
}

void add_errors_of_lengths(const std::vector<Recording>& own, const std::vector<std::vector<UnitSample>>& samples,
                           const Vehicle& vehicle, std::size_t unit, const UncertainLengths& lengths,
                           LeastSquaresCalibration& calibration) {
  constexpr double kNothing = 1e-300, kStiffness = 1e-9;
  std::vector<int> fitted;
  std::vector<ParameterEstimate*> estimates;
  for (ParameterEstimate& p : calibration.parameters) {
    const int at = column::of_key(p.name);
    if (!p.determined || at < 0 || at >= column::truth_clock) continue;
    fitted.push_back(at);
    estimates.push_back(&p);
  }
  if (fitted.empty() || lengths.of.empty() || calibration.time_offset_s.size() != own.size()) return;
  const MatrixXd information = information_of(own, samples, vehicle, unit, lengths, calibration);
  std::vector<int> of_lengths;
  for (int k = column::first_extra; k < information.cols(); ++k) of_lengths.push_back(k);
  const MatrixXd of_fitted = information(fitted, fitted);
  const Eigen::VectorXd size = of_fitted.diagonal().cwiseMax(kNothing).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = size.asDiagonal() * of_fitted * size.asDiagonal();
  scaled.diagonal().array() += kStiffness;
  const MatrixXd moved = size.asDiagonal() * scaled.ldlt().solve(size.asDiagonal() * information(fitted, of_lengths));
  const Eigen::VectorXd added = (moved * lengths.covariance * moved.transpose()).diagonal();
  for (std::size_t i = 0; i < estimates.size(); ++i)
    estimates[i]->stderr_value =
        std::hypot(estimates[i]->stderr_value, std::sqrt(std::max(0.0, added[static_cast<Eigen::Index>(i)])));
}

}  // namespace odolab
