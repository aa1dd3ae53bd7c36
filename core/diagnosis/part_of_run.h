// A short part of a run, to ask the truth about what happened in it.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

// What was read from a second and a half before `from_s` to as long behind `to_s`, on the wheels' clock; the truth's
// stamps are later by `offset_s`.
InnovationRun part_of_run(const InnovationRun& run, double from_s, double to_s, double offset_s);

// Minus twice the log-likelihood of a part; 0 where there is no truth to speak of.
double misfit_of(const InnovationRun& part, const InnovationModel& calibrated);

}  // namespace odolab
