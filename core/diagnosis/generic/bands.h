// Whether something happens in a narrow band of what the vehicle does: where hats over all of it are too wide to show
// it.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/groups.h"

namespace odolab {

// One test for each variable and channel: of all bands, from a fiftieth of the range to a third of it, the one whose
// score is largest for its way. What shakes at one speed, a counter that errs between two, a wheel that lifts in hard
// turns alone show. p values are over `looked_at` tests and all bands.
std::vector<GenericTest> band_tests(const AskedModel& asked, const Shaken& shaken, double looked_at);

}  // namespace odolab
