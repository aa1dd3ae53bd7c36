// Where two clocks were never lined up, the turning of the robot tells how far they are apart.
#pragma once

#include "core/io/import/number_rows.h"

namespace odolab {

// What to add to the truth's stamps so that its yaw rate meets the difference of left_ticks and right_ticks at the
// start of the run: the largest correlation over all shifts and over rates of the truth's clock within 4 %, the shift
// to 10 ms. The rate itself is left to whoever looks into the recording.
double truth_shift_by_turning(const SampledChannels& odometry, const SampledChannels& truth);

}  // namespace odolab
