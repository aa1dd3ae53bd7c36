// Over how much way and turn the errors of recordings are gathered.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/window_size.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// In the median of all their windows, by the vehicle's wheels or commands. Unset where there is none.
std::optional<WindowSize> gathered_over(const std::vector<Recording>& recordings, const Vehicle& vehicle);

}  // namespace odolab
