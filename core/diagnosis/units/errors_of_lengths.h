// What the errors of the lengths by which a unit's own recordings were made add to those of its calibration.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/calibration/least_squares.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// Lengths, angles and the truth's place, as far as they are known.
struct UncertainLengths {
  std::vector<std::function<double&(Vehicle&)>> of;  // where each stands in a vehicle
  Eigen::MatrixXd covariance;
};

// Of the joints what is determined, and the truth's place as the unit that carries it knows that; null where none does.
UncertainLengths uncertain_lengths(const GeometryFit& geometry, const LeastSquaresCalibration* carrying = nullptr);

// A unit whose truth the joints tell is calibrated as if they told it without error. `own`: its recordings, made with
// `vehicle` of `samples`. An error of a length puts the unit's truth off as its joints stand; what that moves from step
// to step is one more column of the filter (core/calibration, Eqs. 2 to 9), so with I the information of one pass,
// d theta = I_tt^-1 I_tg d g, and standard errors of `calibration` get K C K' of the lengths' C on top.
void add_errors_of_lengths(const std::vector<Recording>& own, const std::vector<std::vector<UnitSample>>& samples,
                           const Vehicle& vehicle, std::size_t unit, const UncertainLengths& lengths,
                           LeastSquaresCalibration& calibration);

}  // namespace odolab
