// Joints that turn more slowly than their encoders are read.
#pragma once

#include <vector>

#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// The samples with each joint drawn from edge to edge of its encoder's steps, by cubics over the way of all wheels: a
// joint moves only while the vehicle does, and at an edge, half way between two readings, it is known best. Where it
// turns back within a step it goes as deep into it as its pace before and behind says. Never further from what was read
// than half a step, which the readings themselves show: files name others, or none. As they are read: joints of no step
// or whose readings flicker, where each reading brings a step or more, and what comes before the first edge and behind
// the last.
std::vector<UnitSample> with_joints_drawn(std::vector<UnitSample> samples);

}  // namespace odolab
