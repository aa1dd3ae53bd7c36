// Whether the truth is late, by more at one time or place, or the faster it goes, than at another.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Four tests: hats over the time since the start, of all recordings alike and of each by itself, quadratic polynomials
// of the place, and by the yaw rate and the speed. A truth that is late by so much is off by that times the velocity;
// what it is late by throughout a recording is the clock's offset. A link that buffers, a clock or a filter that is set
// anew, a picture that is read line by line and a matcher that takes longer in turns show. p values are over
// `looked_at` tests.
std::vector<GenericTest> late_truth_tests(const AskedModel& asked, double looked_at);
constexpr int kLateTruthTests = 4;

}  // namespace odolab
