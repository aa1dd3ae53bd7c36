// Truth that comes faster than the vehicle changes its way: several samples made one.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

// How long truth may be averaged over so that a wheel's turn keeps its shape: a tenth of its shortest turn, and no
// longer than 0.05 s; where commands stand in for wheels, 0.02 s.
double averaging_s(const InnovationRun& run);

// The run with its truth averaged over so many samples as come within `longest_s`, each carried to the middle one of
// them by what the wheels did meanwhile (behind commands to the mean of their times); by smoothed readings where counts
// are coarse: carried by rounded ones the mean would agree with their rounding, at the clock that is assumed here and
// at no other. White noise loses nothing by that, since what the wheels do not tell within so short a time is too small
// to matter; and what a filter costs goes with the number of samples. Samples that are set aside are left out where
// others are left: what contradicts for so long is no glitch. The same run where truth does not come that often.
InnovationRun with_averaged_truth(const InnovationRun& run, const InnovationModel& model, double longest_s);

}  // namespace odolab
