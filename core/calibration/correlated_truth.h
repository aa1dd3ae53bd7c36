// Truth that was smoothed before it was recorded, or whose noise lasts for other reasons.
#pragma once

#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// The recording with truth samples left out so that those that remain are so far apart. A tracker that filters its
// poses hands on noise that is no longer independent from sample to sample, and turns late what turned at once; a
// likelihood that takes each sample for a measurement of its own then fits the filter: radii, wheelbase and effects
// with it. Farther apart than the filter lasts, samples are independent again, and between smoothed samples there is
// little to lose.
Recording with_truth_apart(const Recording& recording, double apart_s);

// The correlation of the noise of a truth that is late by `truth_late_s`, from one sample to the next, where the wheels
// have rested for a second, or since the recording began, unless they are those that would have obeyed commands: of
// positions or headings, whichever is larger. Nothing where there are too few such samples to tell 0.2 from 0.5. Only
// this tells a tracker that smooths from a base that follows late or a mast that swings.
std::optional<double> correlation_at_rest(const std::vector<Recording>& recordings, const DifferentialDrive& drive,
                                          double truth_late_s = 0.0, bool by_commands = false);

}  // namespace odolab
