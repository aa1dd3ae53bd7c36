// A wheel that is slower than its encoder is read.
#pragma once

#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// Readings on the grid of whole counts, with those between single counts of one direction drawn onto the straight line
// from one count's edge to the next. Such a wheel turns evenly and does not jump: left as they are, the remainders of
// the counts stay alike for many samples of a fast truth, and their sum passes for motion (a robot at 0.3 m/s with 360
// counts, read at 200 Hz, was calibrated 1.5 % wrong). An edge lies half way between two readings, in time and in
// angle. Untouched: where the wheel rests (`rests.h`) or turns back, and where each reading
// brings a count or more.
std::vector<WheelSample> with_slow_counts_drawn(const std::vector<WheelSample>& readings, double count_rad);

}  // namespace odolab
