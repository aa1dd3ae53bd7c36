// What else happens on a patch of floor that has a name.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Three tests of each slip zone that the model has: so far ahead, to the side and round it is carried on the patch for
// each metre, by where it heads. Slip makes a wheel travel less wherever it heads; a rail turns what passes it towards
// its wall, a dock's funnel pushes aside, a scanner slows what comes near a wall and lets it leave. p values are over
// `looked_at` tests.
std::vector<GenericTest> on_a_patch_tests(const AskedModel& asked, double looked_at);
int count_of_patch_tests(const JointModel& joint);

}  // namespace odolab
