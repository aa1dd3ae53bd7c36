// Joints and wheels of two trucks by what they contradict each other. README.md, "Biases are known from the inside
// too".
#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/others_way.h"

namespace odolab {

// By calibrate_linked; a smart trailer is a truck B with a rigid link.
Result<GeometryFit> geometry_from_inside(const std::vector<Understood>& train, const Vehicle& nominal,
                                         const Progress& progress);

}  // namespace odolab
