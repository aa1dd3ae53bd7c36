// Wheels in the place of commands: what is fitted to them as radii and wheelbase is then the commands' scales.
#pragma once

#include <vector>

#include "core/recording/recording.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

// Whether a recording of these wheels has no more to drive by than commands.
bool has_commands_alone(const Recording& recording, const std::vector<WheelSample>& wheels);

// The rotation of wheels that do what they are told at once, at the time of each command.
std::vector<WheelSample> obeying_wheels(const std::vector<CommandSample>& commands, const DifferentialDrive& drive);

// The recording with these as `left_wheel_rad` and `right_wheel_rad`. A command is held until the next one, for seconds
// where a log has only what changes: there it gets rows at least every hundredth of a second (of the longest, a
// four-thousandth): the vehicle drives along an arc and not along its chord, and follows a command not in one go.
Recording with_obeying_wheels(const Recording& recording, const DifferentialDrive& drive);

}  // namespace odolab
