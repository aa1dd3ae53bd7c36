// Tracks on their floor, coloured along their way by how far something is off there.
#pragma once

#include <string>
#include <vector>

#include "core/io/picture/svg.h"

namespace odolab {

// Positions in their order with a value at each; where one is not finite the line is broken.
struct ColouredTrack {
  std::vector<double> x_m, y_m;
  std::vector<double> times_noise;  // 1: no more than noise
};

struct MarkedDisc {
  double x_m = 0.0, y_m = 0.0, radius_m = 0.0;
  std::string label;
};

struct ColouredTrackPicture {
  std::string title;
  ColouredTrack track;
  std::vector<MarkedDisc> discs;
  double width_px = 520.0;
  double height_px = 440.0;
};

// An SVG file's text. Both axes have the same scale; the colours are steps, so that they can be read off.
std::string coloured_track_picture(const ColouredTrackPicture& picture);

}  // namespace odolab
