// Whether what is left follows acceleration: a wheel that is read later than the other, a marker that sways.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// A reading that is late by so many seconds errs by that times the speed, and so in each interval by that times the
// change of speed; what both wheels are late by is the clock's offset. A mast that bends under its marker errs in
// proportion to the acceleration, ahead and aside, and so by its change; so does a wheel that its drive, a belt or a rubber
// coupling, lets fall behind. p values are over `looked_at` tests.
std::vector<GenericTest> lagging_tests(const AskedModel& asked, double looked_at);
constexpr int kLaggingTests = 3;

}  // namespace odolab
