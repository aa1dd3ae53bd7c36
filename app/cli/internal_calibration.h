// `odolab calibrate` for vehicles whose own encoders are enough.
#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Calibrates, writes `out` where it is not empty, and prints; returns an exit code.
int calibrate_from_inside(const std::vector<Recording>& recordings, const Vehicle& nominal, const std::string& out);

}  // namespace odolab
