// Readings of wheels that come slowly, with others put between them.
#pragma once

#include <vector>

#include "core/recording/vehicle_samples.h"

namespace odolab {

// Where two readings are further apart than 0.03 s, a cubic between them (wheel_line) every 0.025 s or sooner: wheels
// that speed up leave the straight line between both, and the vehicle the arc. The readings themselves stay; nothing is
// put into gaps of half a second and more.
std::vector<WheelSample> finer_readings(const std::vector<WheelSample>& wheels);

}  // namespace odolab
