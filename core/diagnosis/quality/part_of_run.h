// A short part of a run, to ask the truth about what happened in it.
#pragma once

#include <functional>
#include <optional>

#include "core/calibration/innovations.h"

namespace odolab {

// What was read from a second and a half before `from_s` to as long behind `to_s`, on the wheels' clock; the truth's
// stamps are later by `offset_s`.
InnovationRun part_of_run(const InnovationRun& run, double from_s, double to_s, double offset_s);

// Minus twice the log-likelihood of a part; 0 where there is no truth to speak of.
double misfit_of(const InnovationRun& part, const InnovationModel& calibrated);

// How much of a change of what was read a part's truth shows: the likelihood is one of the share of it, a parabola
// through none of it, half and all.
struct ShownShare {
  double best = 0.0;         // 1: all of it
  double gain = 0.0;         // of twice the log-likelihood, by the best share of it
  double gain_of_all = 0.0;  // by all
};
// `misfit`: of a share. Unset where no share is best.
std::optional<ShownShare> shown_share(const std::function<double(double share)>& misfit);

}  // namespace odolab
