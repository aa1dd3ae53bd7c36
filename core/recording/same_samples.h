// Whether two recordings are one run.
#pragma once

#include "core/recording/recording.h"

namespace odolab {

// Whether two recordings hold the same samples in the same columns, as when both files of a pair were given, or a file
// and its copy.
bool same_samples(const Recording& a, const Recording& b);

}  // namespace odolab
