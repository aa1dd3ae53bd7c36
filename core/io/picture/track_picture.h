// Tracks on their floor, seen from above: a metre grid, a scale bar, where the run starts, bumps and slip zones.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/track.h"
#include "core/io/picture/svg.h"
#include "core/scenario/floor.h"

namespace odolab {

struct DrawnTrack {
  std::string label;
  Track track;
  Look look = Look::truth;
};

struct TrackPicture {
  std::string title;
  std::vector<DrawnTrack> tracks;  // the first one has the start marker
  Floor floor;
  double width_px = 900.0;
  double height_px = 700.0;
};

// An SVG file's text. Both axes have the same scale.
std::string track_picture(const TrackPicture& picture);

}  // namespace odolab
