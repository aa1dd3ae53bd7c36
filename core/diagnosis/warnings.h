// What a reader must know beside the findings, in words.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/generic/adequacy.h"

namespace odolab {

// Of what is left beside names, and of the noise under which they were found.
std::vector<std::string> warnings_beside(const JointModel& joint, const Adequacy& adequacy);

}  // namespace odolab
