// Whether the frame that the truth is measured in moves by itself: a map that turns as it grows, a tripod that settles,
// a camera that sags as it warms.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// One test: in each recording the frame turns about the room's origin and shifts along x and y, evenly in time, and
// goes on while the vehicle stands. p values are over `looked_at` tests.
std::vector<GenericTest> moving_frame_tests(const AskedModel& asked, double looked_at);
constexpr int kMovingFrameTests = 1;

}  // namespace odolab
