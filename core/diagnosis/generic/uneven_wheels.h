// Whether a wheel's way depends on its angle more often than once a turn: lobes, teeth, an encoder's own error.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Of each wheel twice and three times a turn, in each recording with a phase of its own, since encoders begin to count
// where the wheel happens to stand. p values are over `looked_at` tests.
std::vector<GenericTest> uneven_wheel_tests(const AskedModel& asked, double looked_at);
constexpr int kUnevenWheelTests = 4;

}  // namespace odolab
