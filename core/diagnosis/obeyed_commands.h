// What a base makes of its commands, where a model says that it makes something else of them than its file does.
#pragma once

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// The recording with its commands as they were obeyed: a base turns its wheels by the radii and the wheelbase of its
// file, and rolls on those that it has. As it is where there are encoders, or where either is no differential drive.
Recording with_obeyed_commands(Recording recording, const Vehicle& file, const Vehicle& fitted);

}  // namespace odolab
