// How quickly wheels speed up, from readings that are rounded.
#pragma once

#include <vector>

#include "core/recording/recording.h"

namespace odolab {

struct WheelAcceleration {
  double left_radps2 = 0.0, right_radps2 = 0.0;                // as quick as the readings show
  double left_steady_radps2 = 0.0, right_steady_radps2 = 0.0;  // over 0.8 s
};

// In the middle of each interval between readings: the second derivative of a parabola through the readings around it,
// by least squares with weights that fall off to either side (local regression: Cleveland and Devlin, JASA 83, 1988).
// They reach as far as needed for what readings tremble by (rounding, stamps) to make up a thousandth of the
// accelerations' variance, from 0.4 s to 0.8 s in all: over wider windows a quick start would come early, end late and
// be told from a clock's offset by too little (a vehicle that turned about in 0.4 s seemed to slip by a quarter less).
// But over shorter ones what a rough floor does to a wheel looks like small accelerations, which cost way: where each
// size of acceleration is asked for by itself, it must be the steady one.
// `readings`: stamps in order; fewer than four give zeros.
std::vector<WheelAcceleration> wheel_accelerations(const std::vector<WheelSample>& readings);

}  // namespace odolab
