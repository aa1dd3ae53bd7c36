// Recordings whose columns are not what their names say, each judged on its own against the vehicle's file: headings in
// degrees, positions in millimetres, wheels exchanged, a wheel's sign, mirrored positions. A recording is at fault only
// where wheels and truth contradict each other as they are and agree once that one thing is put right; slip, drift and
// wrong radii do neither.
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// In place of a recording's name, where all of two or more share a fault.
inline constexpr const char* kEveryRecording = "every recording";

// An Error that names the recording, what its columns look like and what they should be.
std::optional<Error> fault_in(const Recording& recording, const Vehicle& nominal);

// The fault of each recording, where it has one. A fault that all share may as well be the vehicle file's: it is said
// of them together.
std::vector<std::optional<Error>> faults_in(const std::vector<Recording>& recordings, const Vehicle& nominal);

}  // namespace odolab
