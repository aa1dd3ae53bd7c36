// Joints and wheels by what the units of a vehicle contradict each other. README.md, "From the inside".
#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/others_way.h"

namespace odolab {

Result<GeometryFit> geometry_from_inside(const std::vector<Understood>& train, const Vehicle& nominal,
                                         const Progress& progress);

}  // namespace odolab
