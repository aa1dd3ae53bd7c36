// Counts of both wheels as they were at the stamps, where one wheel's are a little older than the other's.
#pragma once

#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Of each recording the right wheel's counts or rotations moved on by so much time at the pace that they have there,
// back if it is negative. Counters that wrap go on; counts need not be whole any more.
std::vector<Recording> with_right_wheel_newer(std::vector<Recording> recordings, const DifferentialDrive& drive,
                                              double by_s);

}  // namespace odolab
