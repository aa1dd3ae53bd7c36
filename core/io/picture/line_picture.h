// Values over time or another variable, one or several lines, with bands and marked stretches.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/io/picture/svg.h"

namespace odolab {

struct DrawnLine {
  std::string label;  // may be empty where there is one line alone
  std::vector<double> x;
  std::vector<double> y;  // as many; NaN leaves a gap
  Look look = Look::truth;
};

// Between which values something may lie; under the lines.
struct DrawnBand {
  std::string label;
  std::vector<double> x, low, high;  // as many of each
  Look look = Look::truth;
};

struct LinePicture {
  std::string title;
  std::string x_label = "time [s]";
  std::string y_label;  // with its unit
  std::vector<DrawnLine> lines;
  double width_px = 900.0;
  double height_px = 360.0;
  std::vector<DrawnBand> bands = {};
  std::vector<std::pair<double, double>> marked = {};  // stretches of x with something to see in them
  std::string marked_label = {};
  const char* marked_ink = ink::kMarked;
};

// An SVG file's text. Each column of pixels keeps the lowest and the highest value that falls into it.
std::string line_picture(const LinePicture& picture);

}  // namespace odolab
