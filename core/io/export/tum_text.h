// A track as a TUM trajectory, which evo and most SLAM tools read: `timestamp tx ty tz qx qy qz qw`, blanks between.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/geometry/track.h"

namespace odolab {

// On the plane z = 0, turned about z. Numbers read back to the same bits.
std::string tum_text(const Track& track);
Result<Done> write_tum(const std::string& path, const Track& track);

}  // namespace odolab
