// What counting itself makes: readings that hide up to half a count, and come back to where they were.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// Lets a group that comes and goes say nothing where it carries no wheel further to either side than a reading hides of
// it, at speeds at which readings do so: wheels that turn evenly by nearly a whole number of counts from reading to
// reading are read too far and too short in turns, metre after metre.
void leave_to_counting(GenericTest& test, const JointModel& joint);

// Lets a group say nothing that displaces a rim by no more than whole counts hide: what comes and goes with changes of
// the vehicle's motion, since a driver's changes come when counts do, and all else where counts are coarse.
void leave_displaced_to_counting(GenericTest& test, const JointModel& joint);

}  // namespace odolab
