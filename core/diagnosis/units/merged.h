// The diagnoses of a vehicle's units as one of the vehicle.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/outside_truth.h"

namespace odolab {

bool any_cannot_say(const std::vector<Diagnosis>& diagnoses);

// What findings come to; `cannot_say`: where there are none.
Verdict verdict_by(const std::vector<Finding>& findings, bool cannot_say);

// `diagnoses`: one for each unit of the vehicle, in their order. Effects that all units share become one finding; what
// of a unit's truth seems to sit elsewhere is a biased encoder of its joint. `truth`: what there is of one; by the
// poses at both ends no unit was judged, but where the tracked point sits is known.
Diagnosis merged(const std::vector<Diagnosis>& diagnoses, const GeometryFit& geometry, const Vehicle& nominal,
                 const std::vector<Recording>& recordings, OutsideTruth truth = OutsideTruth::poses);

}  // namespace odolab
