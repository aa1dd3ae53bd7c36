// Wheel readings without the steps of their counts.
#pragma once

#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// Each reading as the middle of a straight line through its neighbours: as many as span sixteen counts, none further
// away than 0.25 s. A reading's rounding error is in its own difference to the next one, so that derivatives by anything
// that is multiplied with that difference would be correlated with the error they are to explain (errors in variables:
// Fuller, Measurement Error Models, 1987, 1.1); those of the smoothed readings hardly are. Times stay as they are.
std::vector<WheelSample> smoothed_counts(const std::vector<WheelSample>& readings, double count_rad);

}  // namespace odolab
