// Where commands are no input: none were logged for a while, or the base did not move whatever it was told.
#pragma once

#include <vector>

#include "core/calibration/left_out.h"
#include "core/recording/recording.h"

namespace odolab {

// A command, held until the next.
struct HeldCommand {
  double time_s = 0.0, speed_mps = 0.0, yaw_rate_radps = 0.0;
};
std::vector<HeldCommand> held_commands(const Recording& recording);

// Rows missing from a log that has them evenly, but where the base is told to rest before the hole and behind it. Each
// from one row to the next. None in a log that has a row for each change.
TimeStretches holes_in_commands(const std::vector<HeldCommand>& commands);

// Where for two seconds and more the truth hardly moves though the commands of that time, and of half a second sooner,
// lead away: the base is blocked, or lifted, or deaf to what is small. None where the truth as often moves without a
// command: then its clock is off.
TimeStretches unmoved_base(const std::vector<HeldCommand>& commands, const std::vector<TruthSample>& truth);

}  // namespace odolab
