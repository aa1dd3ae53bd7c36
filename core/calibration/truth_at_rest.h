// The truth where the wheels rest: what its noise does by itself, whatever the vehicle does.
#pragma once

#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// The samples of one rest. Headings are empty where the truth has none.
struct TruthAtRest {
  std::vector<double> time_s, x_m, y_m, heading_rad;
};

// Of a truth that is late by `truth_late_s`: where the wheels have rested for a second, or since the recording began,
// unless they are those that would have obeyed commands.
std::vector<TruthAtRest> truth_at_rest(const std::vector<Recording>& recordings, const DifferentialDrive& drive,
                                       double truth_late_s, bool by_commands);

}  // namespace odolab
