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

}  // namespace odolab
