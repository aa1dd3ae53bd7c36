// Where commands are no input: none were logged for a while, or the base did not move whatever it was told. Commands
// are given as the wheels that would have obeyed them, by `drive`.
#pragma once

#include <vector>

#include "core/calibration/left_out.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Rows missing from a log that has them evenly, but where the base is told to rest before the hole and behind it. Each
// from one row to the next. None in a log that has a row for each change: in most of its long intervals the truth goes
// on as was told last.
TimeStretches holes_in_commands(const std::vector<WheelSample>& obeyed, const DifferentialDrive& drive,
                                const std::vector<TruthSample>& truth);

// Where for two seconds and more the truth hardly moves though the commands of that time, and of half a second sooner,
// lead away: the base is blocked, or lifted, or deaf to what is small. None where the truth as often moves without a
// command: then its clock is off.
TimeStretches unmoved_base(const std::vector<WheelSample>& obeyed, const DifferentialDrive& drive,
                           const std::vector<TruthSample>& truth);

}  // namespace odolab
