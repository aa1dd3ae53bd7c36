// What a calibration leaves: whether another one would correct it or fit chance.
#pragma once

#include <string>

#include "core/calibration/umbmark.h"

namespace odolab {

// Two places that a tape cannot tell apart: the spread of returns is never taken to be less.
inline constexpr double kTapeRounding_m = 0.0005;

struct RestOfCalibration {
  bool worth_another = false;  // false, too, where nobody can tell
  std::string sentence;
};

// The report's rule (section 6.3): another compensation is worth while where the worse centre lies more than 3 of its
// standard errors from the origin. Squares on a perfect floor end all alike, and by the rule alone the last tenth of a
// millimetre would ask for another; so the spread behind the standard error is at least the rounding of a tape.
RestOfCalibration rest_of(const UmbmarkMeasure& measure, const UmbmarkRuns& runs);

}  // namespace odolab
