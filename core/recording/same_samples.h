// Whether two recordings are one run.
#pragma once

#include <string>

#include "core/recording/recording.h"

namespace odolab {

// Whether two recordings hold the same samples in the same columns, as when both files of a pair were given, or a file
// and its copy.
bool same_samples(const Recording& a, const Recording& b);

// Sixteen hexadecimal digits that recordings with the same samples in the same columns share, and others do not but by
// chance (FNV-1a, 64 bits): by which a file tells which run it speaks of, whatever that is called.
std::string fingerprint(const Recording& recording);

}  // namespace odolab
