// How quickly wheels speed up, from readings that are rounded.
#pragma once

#include <vector>

#include "core/recording/recording.h"

namespace odolab {

struct WheelAcceleration {
  double left_radps2 = 0.0, right_radps2 = 0.0;
};

// In the middle of each interval between readings: the second derivative of a parabola through the readings around it,
// by least squares with weights that fall off to either side (local regression: Cleveland and Devlin, JASA 83, 1988).
// They reach as far as needed for what readings tremble by (rounding, stamps) to make up a thousandth of the
// accelerations' variance, from 0.4 s to 0.8 s in all: fine encoders show a quick start as it is. Over wider windows it
// would come early, end late and be told from a clock's offset by too little (a vehicle that turned about in 0.4 s
// seemed to slip by a quarter less); over shorter ones what the floor does to a wheel hides it. A parabola's second
// derivative does not answer to a jump in its middle: what a floor does at one moment is not taken for the
// acceleration of that moment.
// `readings`: stamps in order; fewer than four give zeros.
std::vector<WheelAcceleration> wheel_accelerations(const std::vector<WheelSample>& readings);

}  // namespace odolab
