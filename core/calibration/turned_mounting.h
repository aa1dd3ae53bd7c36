// A tracked body that sits on the vehicle turned by any angle: a marker glued on sideways, headings counted from north.
#pragma once

#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// The vehicle with its tracked body turned as the recordings have it, each by itself and all alike, where that is so
// far from what the file says that no fit would find the way there; else as it is given. Of a differential drive with
// wheels and a truth with headings (run_fit.h).
Vehicle turned_as_driven(const std::vector<Recording>& recordings, const Vehicle& nominal);

}  // namespace odolab
