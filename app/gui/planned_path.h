// The line that a driver means to follow, for the picture of the floor.
#pragma once

#include <vector>

#include "core/scenario/scenario.h"

namespace odolab {

// Corners of the line on the floor, from where the steered point starts; empty where a path has no line, as with wheel
// speeds.
std::vector<Vec2> planned_path(const Scenario& scenario, const Pose& start);

}  // namespace odolab
