// Recordings as they are given to a diagnosis: which can be judged, and by what names they are spoken of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// What keeps a recording from being judged at all; `path` stands for it in the error.
std::optional<Error> unusable(const Recording& recording, const Vehicle& vehicle, const std::string& path);

// Ticks of a vehicle whose file does not say how many make a turn; `path` stands for the recording in the error.
std::optional<Error> ticks_of_unknown_size(const Recording& recording, const Vehicle& vehicle, const std::string& path);

// The first recording that is another one once more; `paths` stand for them in the error. Twice as sure of a run's
// noise a fit takes it for physics.
std::optional<Error> given_twice(const std::vector<Recording>& recordings, const std::vector<std::string>& paths);

// A recording's name stands for it in all that is said; where two files have one name, as much of the path as tells
// them apart is put before it.
void make_names_differ(std::vector<Recording>& recordings, const std::vector<std::string>& paths);

}  // namespace odolab
