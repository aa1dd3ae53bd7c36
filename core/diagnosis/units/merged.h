// The diagnoses of a vehicle's units as one of the vehicle.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// `diagnoses`: one for each unit of the vehicle, in their order. Effects that all units share become one finding; what
// of a unit's truth seems to sit elsewhere is a biased encoder of its joint. `from_outside`: where there is a truth
// that one of them may carry.
Diagnosis merged(const std::vector<Diagnosis>& diagnoses, const GeometryFit& geometry, const Vehicle& nominal,
                 const std::vector<Recording>& recordings, bool from_outside = true);

}  // namespace odolab
