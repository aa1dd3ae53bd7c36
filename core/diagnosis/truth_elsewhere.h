// A truth that is somewhere else for a while and then back: a tracker that lost a marker and took its body for turned.
#pragma once

#include "core/calibration/innovations.h"
#include "core/calibration/left_out.h"

namespace odolab {

// Stretches of up to two seconds, on the truth's clock, in which more samples in a row contradict the wheels than the
// filter bears, and behind which the truth lies where the wheels went on to from what was before. Fewer samples are
// outliers (model/outlying.h).
TimeStretches truth_elsewhere(const InnovationRun& run, const InnovationModel& model);

}  // namespace odolab
