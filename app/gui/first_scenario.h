// What a person sees before they have opened anything.
#pragma once

#include "core/scenario/scenario.h"

namespace odolab {

// The LabMate on its square with a cable across the way, its wheels and wheelbase a little off.
Scenario first_scenario();

}  // namespace odolab
