// Stretches of a recording across which the wheels' way is not known: gaps between readings, readings at fault, and
// what lies before the first reading and behind the last. README.md in this folder, "Left out".
#pragma once

#include <utility>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

using TimeStretches = std::vector<std::pair<double, double>>;  // from, to, in seconds

// Which intervals between readings last for more than 0.2 s and so many usual ones; none of fewer than 20 readings.
std::vector<std::size_t> long_intervals(const std::vector<WheelSample>& readings, double times_usual);

// Where readings are missing: an interval of more than 0.2 s and 2.5 usual ones, in which a wheel turned further than
// from one reading to the next elsewhere. A log that only has what changes leaves none where the wheels rest.
TimeStretches encoder_gaps(const std::vector<WheelSample>& readings);

// In order, and those that touch are one.
TimeStretches joined(TimeStretches stretches);

// Readings as they may stand on either side of stretches that are left out, whose ends are readings: none are within,
// and where a wheel would have turned in one faster than it can (a counter that starts again) all behind are moved by
// whole counts, so that it goes on as before. Angles and speeds near by are then right; the way across stays unknown.
std::vector<WheelSample> bridged(std::vector<WheelSample> readings, const TimeStretches& left_out, double count_rad);

// Whether what a run leaves out lies between two times of its wheels.
bool leaves_out(const InnovationRun& run, double from_s, double to_s);

// Writes into `cut` between which truth samples the way is not known, where the truth's clock is late by `offset_s` and
// the wheels' is fast by `rate`: across what the run leaves out, and further beyond the first and the last reading than
// the wheels can be taken to go on as they did, which is a tenth of an interval where they turn and one interval where
// they rest. To be asked again when the clock is known better, but not within a fit: a sample more would look like a
// worse one.
void cut_where_left_out(InnovationRun& run, double offset_s, double rate = 0.0);

}  // namespace odolab
