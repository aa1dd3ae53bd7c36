// Over how long a truth is smoothed, by what it does while the vehicle rests.
#pragma once

#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Samples of a truth that is late by `truth_late_s` are independent from that time on, but for what wanders slowly:
// there the way from one sample to the next goes back half of what the way before it came. Zero where neighbours are
// so already; nothing where too few samples rest (`correlation_at_rest` says where they do), or no such time shows
// within 0.3 s.
std::optional<double> smoothed_for_s(const std::vector<Recording>& recordings, const DifferentialDrive& drive,
                                     double truth_late_s = 0.0, bool by_commands = false);

}  // namespace odolab
