// Where an encoder jumps: between two readings it makes a step that no wheel could make.
#pragma once

#include <vector>

#include "core/calibration/left_out.h"

namespace odolab {

// Of the readings `angle_rad` at `time_s`, of a wheel of `radius_m`; `count_rad` is the smallest step that was read.
// Each stretch goes from the reading before a jump to the one behind it.
TimeStretches encoder_jumps(const std::vector<double>& time_s, const std::vector<double>& angle_rad, double radius_m,
                            double count_rad);

}  // namespace odolab
