// Whether what is left comes and goes, at whatever length: in time, along the way, with the turning, or along the
// floor.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// The strongest waves in each channel: long, middling and short ones. p values are over all lengths and directions that
// were looked at, and over `other_tests` beside them. On the floor all recordings share phase and amplitude; elsewhere
// each has its own (what drives it did not start with the recording: a castor, a gear, a draught).
std::vector<GenericTest> wave_tests(const AskedModel& asked, double other_tests);

}  // namespace odolab
