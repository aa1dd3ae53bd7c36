// A recording as a CSV file for PlotJuggler: its names grouped by '/', as its tree of curves shows them.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/recording/recording.h"

namespace odolab {

// "left_wheel_rad" as "wheels/left_wheel_rad", "truth_x_m" as "truth/x_m", "command_speed_mps" as "command/speed_mps".
std::string plotjuggler_name(const std::string& channel);

// `time_s` first. Cells are empty where a channel was not sampled, which PlotJuggler takes as no point; every number
// has a decimal point, as PlotJuggler makes out what a column is by its first cell.
Result<Done> write_plotjuggler_csv(const std::string& path, const Recording& recording);

}  // namespace odolab
