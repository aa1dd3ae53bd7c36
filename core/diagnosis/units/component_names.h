// The components of findings: of a unit by itself, and in the vehicle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// "truck_a.left_wheel", "castor2", or "floor" and "truth", which belong to no unit.
std::string component_of_unit(const std::string& unit, const std::string& component);
// The other way: the unit's own word, where it is of that unit. "vehicle", "floor" and "truth" are of every unit.
std::optional<std::string> component_in_unit(const std::string& unit, const std::string& component,
                                             const std::vector<VehicleUnit>& all);

}  // namespace odolab
