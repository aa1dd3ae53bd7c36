// Whether the wheelbase depends on a wheel's angle: a bent axle, a wheel that wobbles, whose contact goes in and out.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Of each wheel the turn for each radian that is turned, once a turn of the wheel, in each recording with a phase of
// its own. p values are over `looked_at` tests.
std::vector<GenericTest> wobbling_wheel_tests(const AskedModel& asked, double looked_at);
constexpr int kWobblingWheelTests = 2;

}  // namespace odolab
