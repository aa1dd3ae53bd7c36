// Where a calibration starts whose truth has no headings.
#pragma once

#include <optional>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

struct ShapeGuess {
  DifferentialDrive drive;  // wheel radii and wheelbase
  Vec2 tracked_m;           // of the tracked point on the axle's frame
};

// The radii, the wheelbase and the tracked point with which dead reckoning, stretch by stretch and laid onto the truth
// as a rigid shape, fits it best (simplex; stretches of some seconds, the worst tenth of them left out). A filter that
// starts some per cent off and must find headings besides takes all of it for noise. Nothing where a run has headings,
// or where even the best leaves more than a twentieth of the stretches' size.
std::optional<ShapeGuess> shape_guess(const std::vector<InnovationRun>& runs, const DifferentialDrive& nominal,
                                      const TruthMounting& mounting);

}  // namespace odolab
