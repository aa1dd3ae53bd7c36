// Wheel readings without what makes them tremble.
#pragma once

#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// Each reading as the middle of a parabola through its neighbours up to 0.25 s away, as many on either side and two or
// more. (A straight line lags and leads where a wheel speeds up: at corners it blurred the end of the way into the
// turn, and a lateral slip came out seven times too large.) What the odometry is to be differentiated by is taken from
// these: a reading's own rounding, and the floor that holds a wheel up for a moment, are in its difference to the next
// one, so that derivatives by anything that is multiplied with that difference would be correlated with the error that
// they are to explain (errors in variables; smoothed readings serve as instruments: Fuller, Measurement Error Models,
// 1987, 1.4). Times stay as they are.
std::vector<WheelSample> smoothed(const std::vector<WheelSample>& readings);

}  // namespace odolab
