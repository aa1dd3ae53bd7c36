// A track as a CSV file: `time_s,x_m,y_m,heading_rad`.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/geometry/track.h"

namespace odolab {

// All four columns are required and have a number in every row; others are ignored. Headings come unwrapped.
Result<Track> read_track_csv(const std::string& path);

// Numbers read back to the same bits.
Result<Done> write_track_csv(const std::string& path, const Track& track);

}  // namespace odolab
