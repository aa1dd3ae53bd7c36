// A scenario driven to its end, and what it recorded.
#pragma once

#include <optional>

#include "core/base/progress.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace odolab {

// None where the robot never arrives (three times the planned time) or `progress` stopped it.
std::optional<Recording> driven_recording(const Scenario& scenario, std::uint64_t seed, const Progress& progress = {});

}  // namespace odolab
