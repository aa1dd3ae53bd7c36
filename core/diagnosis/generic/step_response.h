// What a base that is driven by its commands makes of each change of them, beyond what the model has it do.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// One test, of recordings that hold only commands; else none. Hats over the time since a command changed: by what share
// of the change, of speed and yaw rate alike, the base goes faster or slower than the model has it. A loop that
// overshoots, ramps that are limited and brakes that take hold late show, whatever they are called. p values are over
// `looked_at` tests.
std::vector<GenericTest> step_response_tests(const AskedModel& asked, double looked_at);
constexpr int kStepResponseTests = 1;

}  // namespace odolab
