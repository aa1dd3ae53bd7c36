// Whether the names that were given suffice, by all that is asked of them.
#pragma once

#include "core/diagnosis/generic/adequacy.h"
#include "core/diagnosis/named.h"

namespace odolab {

// `of_calibration`: the noise as calibration alone has it; `error`: what something without a name may have of the
// family-wise error.
Adequacy judged_adequacy(const Named& named, const JointModel& calibrated, const Predictor& predictor,
                         const FittedNoise& of_calibration, double error);

}  // namespace odolab
