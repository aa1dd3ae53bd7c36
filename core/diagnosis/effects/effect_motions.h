// What effects add to a drive's motion.
#pragma once

#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

// For each wheel interval of the view, of one effect with one value for each of its amplitudes.
Motions motion_of(const Effect& effect, const DriveView& view, const std::vector<double>& shape,
                  const std::vector<double>& value);

// Of all effects that are switched on; what acts on clocks, on the truth or on commands that are not there adds
// nothing.
std::vector<BodyMotion> motions_of(const DriveView& view, const std::vector<ActiveEffect>& effects);

}  // namespace odolab
