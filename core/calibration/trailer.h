// Self-calibration of a vehicle with a Smart Encoder Trailer: what the wheels of both and the hitch's encoder
// contradict.
//
// Over each stretch both dead reckonings predict the hitch angle, and where the hitch lies as seen from the trailer: a
// drawbar straight ahead. That is explained by unequal wheels and wheelbases of both, the trailer's scale, the
// drawbar's length and a biased encoder; least squares over stretches as for linked trucks.
#pragma once

#include <vector>

#include "core/calibration/internal.h"

namespace odolab {

// The scale, which is that of the towing vehicle's mean wheel radius, is taken as known. In one steady curve, straight
// on too, a biased hitch looks like unequal wheels: the drive needs turns on the spot and ways with the trailer at an
// angle. What the recordings cannot tell keeps its value and is said.
Result<InternalCalibration> calibrate_trailer(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                              const Progress& progress = {});

}  // namespace odolab
