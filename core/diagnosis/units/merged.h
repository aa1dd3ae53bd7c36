// The diagnoses of a vehicle's units as one of the vehicle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// "truck_a.left_wheel", "castor2", or "floor" and "truth", which belong to no unit.
std::string component_of_unit(const std::string& unit, const std::string& component);
// The other way: the unit's own word, where it is of that unit. "vehicle", "floor" and "truth" are of every unit.
std::optional<std::string> component_in_unit(const std::string& unit, const std::string& component,
                                             const std::vector<VehicleUnit>& all);

// `diagnoses`: one for each unit of the vehicle, in their order. Effects that all units share become one finding; what
// of a unit's truth seems to sit elsewhere is a biased encoder of its joint. `from_outside`: where there is a truth
// that one of them may carry.
Diagnosis merged(const std::vector<Diagnosis>& diagnoses, const GeometryFit& geometry, const Vehicle& nominal,
                 const std::vector<Recording>& recordings, bool from_outside = true);

}  // namespace odolab
