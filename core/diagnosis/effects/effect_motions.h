// What effects that are switched on add to a drive's motion.
#pragma once

#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

// For each wheel interval of the view; what acts on clocks, on the truth or on commands that are not there adds
// nothing.
std::vector<BodyMotion> motions_of(const DriveView& view, const std::vector<ActiveEffect>& effects);

}  // namespace odolab
