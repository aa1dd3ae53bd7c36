// Of which part of the vehicle, or of what measures it, something without a name is.
#pragma once

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// Says of what has no name that it is of the truth, or of one wheel, where the channel in which it shows is of these.
// `has_units`: of a vehicle of several frames, whose wheels are said of one frame only, and whose truth may be another
// frame.
void say_parts_of_unnamed(Diagnosis& diagnosis, bool has_units);

}  // namespace odolab
