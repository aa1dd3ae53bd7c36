// What a base that is driven by its commands makes of each change of them, beyond what the model has it do.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Three tests, of recordings that hold only commands; else none. Hats over the time since a command changed: by what
// share of the change, of speed and yaw rate alike, the base goes faster or slower than the model has it; by how much
// more of it a wheel does that is told to go more slowly, which no lag tells from one that is told to go faster; and by
// how much more where the change is larger. A loop that overshoots, wheels that coast, ramps that are limited and
// brakes that take hold late show, whatever they are called. p values are over `looked_at` tests.
std::vector<GenericTest> step_response_tests(const AskedModel& asked, double looked_at);
constexpr int kStepResponseTests = 3;

}  // namespace odolab
