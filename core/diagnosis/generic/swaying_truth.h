// What a truth that sways slowly makes: cameras that warm, a frame that bends, reflections that come and go.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Lets a group that comes and goes with time say nothing against names where it carries the vehicle no further to
// either side, along x and along y of the floor, than a single sample of the truth errs: a place that is off for a while
// and comes back was never left, and whether it is the truth that sways cannot be told. What it says stays in its
// `sway`. Rests can tell: a truth sways on while the wheels stand. Where nothing sways there, and the rests contradict
// what would, the group becomes what carries the vehicle as it drives.
void leave_to_swaying_truth(GenericTest& test, const AskedModel& asked);

}  // namespace odolab
