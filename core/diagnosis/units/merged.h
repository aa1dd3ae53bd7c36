// The diagnoses of a vehicle's units as one of the vehicle.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

bool any_cannot_say(const std::vector<Diagnosis>& diagnoses);

// A warning of a unit's own diagnosis, as one of the vehicle. What stands for the truth of a unit that does not carry
// it is said where the warning speaks of one. `truth`: what there is of one outside.
std::string said_of_unit(const std::string& warning, const VehicleUnit& unit, OutsideTruth truth);

// What findings come to; `cannot_say`: where there are none.
Verdict verdict_by(const std::vector<Finding>& findings, bool cannot_say);

// `diagnoses`: one for each unit of the vehicle, in their order. Effects that all units share become one finding; what
// of a unit's truth seems to sit elsewhere is a biased encoder of its joint. `truth`: what there is of one; by the
// poses at both ends no unit was judged, but where the tracked point sits is known.
Diagnosis merged(const std::vector<Diagnosis>& diagnoses, const GeometryFit& geometry, const Vehicle& nominal,
                 const std::vector<Recording>& recordings, OutsideTruth truth = OutsideTruth::poses);

}  // namespace odolab
