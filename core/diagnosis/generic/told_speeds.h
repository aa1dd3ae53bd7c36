// What a base that is driven by its commands makes of each speed that it is told.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Two tests, of recordings that hold only commands; else none. Hats over a speed's size, whichever its sign: by what
// share of it a wheel goes further, the same for both, each by its own speed; and the base, by its speed and by its yaw
// rate. Commands that are too small to be obeyed or too large, and gears that are not in proportion, show. p values are
// over `looked_at` tests.
std::vector<GenericTest> told_speed_tests(const AskedModel& asked, double looked_at);
constexpr int kToldSpeedTests = 2;

}  // namespace odolab
