// What a base does for a while after its speed changed, when its wheels know nothing of it.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Two tests, of recordings with encoders (`step_response.h` has those of commands). Hats over the time since a change
// of speed, and of yaw rate: by what share of the change the base goes faster or slower than its wheels. A load that
// sloshes, a frame that twists and springs back and rubber that gives way show, whatever they are called. p values are
// over `looked_at` tests.
std::vector<GenericTest> after_change_tests(const AskedModel& asked, double looked_at);
constexpr int kAfterChangeTests = 2;

}  // namespace odolab
