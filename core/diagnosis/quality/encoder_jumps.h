// Where an encoder jumps: between two readings it makes a step that no wheel could make, or one that the truth
// contradicts.
#pragma once

#include <vector>

#include "core/calibration/innovations.h"
#include "core/calibration/left_out.h"

namespace odolab {

// Of the readings `angle_rad` at `time_s`, of a wheel of `radius_m`; `count_rad` is the smallest step that was read.
// Each stretch goes from the reading before a jump to the one behind it.
TimeStretches encoder_jumps(const std::vector<double>& time_s, const std::vector<double>& angle_rad, double radius_m,
                            double count_rad);

// Without those in which both wheels make the same whole number of their steps before and behind at once: there a
// log lost rows, and the stamps of the others were too coarse to show it.
TimeStretches without_lost_rows(const TimeStretches& jumps, const std::vector<WheelSample>& wheels);

struct JumpsOfWheels {
  TimeStretches left, right, both;  // of one alone, and of both at once
};

// Readings of a wheel, or of both at once, that are off the pace before and behind them by a quarter of its usual speed,
// or that lose so much of an even pace as it never trembles by, though a wheel might, where the truth shows beyond
// doubt that the vehicle went on at its pace: each from one reading to the next, or to the next but one where a counter
// did not count from within the one until within the other.
JumpsOfWheels jumps_against_truth(const InnovationRun& run, const InnovationModel& calibrated);

}  // namespace odolab
