// Wheel readings without what makes them tremble.
#pragma once

#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// Each reading as the middle of a straight line through its neighbours up to 0.25 s away, as many on either side. What
// the odometry is to be differentiated by is taken from these: a reading's own rounding, and the floor that holds a
// wheel up for a moment, are in its difference to the next one, so that derivatives by anything that is multiplied with
// that difference would be correlated with the error that they are to explain (errors in variables; smoothed readings
// serve as instruments: Fuller, Measurement Error Models, 1987, 1.4). Times stay as they are.
std::vector<WheelSample> smoothed(const std::vector<WheelSample>& readings);

}  // namespace odolab
