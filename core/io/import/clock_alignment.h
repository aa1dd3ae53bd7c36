// Where two clocks were never lined up, the turning of the robot tells how far they are apart.
#pragma once

#include "core/io/import/number_rows.h"

namespace odolab {

// What to add to the truth's stamps so that its yaw rate agrees best with the difference of left_ticks and right_ticks:
// the largest correlation over all shifts that leave half of the shorter one overlapping, to 10 ms.
double truth_shift_by_turning(const SampledChannels& odometry, const SampledChannels& truth);

}  // namespace odolab
