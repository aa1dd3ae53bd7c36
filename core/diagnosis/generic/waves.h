// Whether what is left comes and goes, at whatever length: in time, or along the floor.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// The strongest waves in each channel: long, middling and short ones. p values are over all lengths and directions that
// were looked at, and over `other_tests` beside them. In time each recording has a phase and an amplitude of its own
// (what drives it did not start with the recording), on the floor all share them.
std::vector<GenericTest> wave_tests(const JointModel& joint, double other_tests);

}  // namespace odolab
