// UMBmark's return position errors of both directions with their centres of gravity, as Fig. 3.4 of the report.
#pragma once

#include <string>
#include <vector>

#include "core/calibration/umbmark.h"

namespace odolab {

// One experiment, e.g. before or after the calibration.
struct DrawnUmbmark {
  std::string label;  // may be empty where there is one alone
  UmbmarkRuns runs;
};

struct ScatterPicture {
  std::string title;
  std::vector<DrawnUmbmark> experiments;  // the first and the last are drawn
  double width_px = 720.0;
  double height_px = 640.0;
};

// An SVG file's text: x and y in millimetres at one scale, clockwise orange discs, counter-clockwise blue
// squares, open where another experiment follows; black crosses are the centres of gravity.
std::string scatter_picture(const ScatterPicture& picture);

}  // namespace odolab
