// Which way an axle looks by the way it goes: no axle rolls sideways. Of a towing vehicle whose own wheels say nothing
// of its way, as tracks, this alone tells how the truth's heading is mounted: to the hitch's encoder a turned mounting
// is a bias.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/track.h"

namespace odolab {

struct HeadingOfWay {
  double mounting_rad = 0.0;  // of the tracked heading, from the axle's
  double stderr_rad = 0.0;
};

// By stretches of a metre, or of half a radian and 0.3 m; none where these are few.
std::optional<HeadingOfWay> heading_of_way(const std::vector<Track>& tracked);

}  // namespace odolab
