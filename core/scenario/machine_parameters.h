// What a machine has that no drawing says, as one list for those who show or edit it.
#pragma once

#include "core/scenario/scenario.h"
#include "core/vehicle/parameters.h"

namespace odolab {

// Weights, the link's spring, tracks and wheels as built: of the parts that the scenario's kind of vehicle has. The
// values may be changed through the list.
std::vector<VehicleParameter> machine_parameters_of(Scenario& scenario);

}  // namespace odolab
