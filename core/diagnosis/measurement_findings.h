// Findings that are of how it was measured: the truth's mounting, its clock, and faults of the data.
#pragma once

#include <algorithm>
#include <vector>

#include "core/calibration/moved_mounting.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/naming/intervals.h"
#include "core/diagnosis/quality/quality.h"

namespace odolab {

// A biased joint is named above so many standard errors, a mounting or a clock above so many, each with a least size of
// its own. Of 460 mountings and clocks of three seeds with nothing missing none was off by three of them.
constexpr double kSigmasOfBias = 6.0, kSigmasOfTruth = 4.5;
constexpr double kLeastClock_s = 0.002;  // of an offset that is said
// By how much a tracked point must be elsewhere to be said: less on a small robot.
inline double least_mounting_m(double wheelbase_m) { return std::min(0.0005, 0.005 * wheelbase_m); }
// And so far from the file it still sits where a hand would put it.
inline double sits_right_m(double wheelbase_m) { return std::min(0.002, 0.02 * wheelbase_m); }

// Where the mounting is not where the vehicle's file says. A small turn of it alone is what wheels do that are not
// square to the axle; then that is the name, with the mounting beside it.
void add_mounting(std::vector<Finding>& findings, const JointModel& joint, const Intervals& intervals,
                  const LeastSquaresCalibration& fit, const Vehicle& nominal);

// A late base that follows commands, and a late truth, are the same: both are said, the base first where it is later
// than a clock that was set.
void add_clock(std::vector<Finding>& findings, const JointModel& joint, const Intervals& intervals,
               const LeastSquaresCalibration& fit, const Vehicle& nominal, bool from_commands);

// The order of findings: what calibration leaves, the strongest first, before what it finds itself (where the truth
// sits on the vehicle, its clock, and a delay that is the same as that).
bool comes_first(const Finding& a, const Finding& b);

// A fault of the data, which stands beside all physics.
Finding finding_of(const DataFault& fault);

// The tracked point of one recording that sat elsewhere: a fault of its data, put right before all else.
Finding finding_of(const MovedMounting& moved);

}  // namespace odolab
