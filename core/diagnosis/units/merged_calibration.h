// The calibrations of a vehicle's units as one of the vehicle, in the words of its file.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// `which`: of each unit's diagnosis. Joints and, where no unit carries it, the truth are the geometry's.
LeastSquaresCalibration merged_calibration(const std::vector<Diagnosis>& diagnoses,
                                           LeastSquaresCalibration Diagnosis::*which, const GeometryFit& geometry,
                                           const std::vector<VehicleUnit>& units, const Vehicle& nominal);

// By how much further to the left a castor's axle lies, as its own recording has it, than where the geometry has it.
struct AxleAside {
  double moved_m = 0.0, stderr_m = 0.0;
};
AxleAside axle_aside(const LeastSquaresCalibration& of_castor, const GeometryFit& geometry, std::size_t unit);
}  // namespace odolab
