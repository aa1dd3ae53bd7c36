// A wheel that seems two or four times as large or small as the vehicle's file has it, where the other does not: no
// wheel is made so, but one side of an encoder's wiring or settings is.
#pragma once

#include <string>
#include <vector>

#include "core/calibration/least_squares.h"

namespace odolab {

struct MiscountedWheel {
  std::string radius, component;  // "wheel_radius_right_m", "right_wheel"
  double times = 1.0;             // as large: 2, 4, 1/2 or 1/4
};

// Of the radii of a calibration, which must not leave their scale open.
std::vector<MiscountedWheel> miscounted_wheels(const LeastSquaresCalibration& calibration);

// "its encoder counts half of what the file says (one channel, or other settings of one side)".
std::string counts_in_words(const MiscountedWheel& wheel);

// "The right wheel seems twice as large as the file says: " and the same.
std::string in_words(const MiscountedWheel& wheel);

}  // namespace odolab
