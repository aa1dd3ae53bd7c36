// Horizontal bars in groups, each with its label and its value in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/picture/svg.h"

namespace odolab {

struct DrawnBar {
  std::string label;
  double value = 0.0;  // 0 or more; not finite: no bar
  std::string value_text;
  std::string colour = ink::kBlue;
};

struct BarGroup {
  std::string title;  // may be empty
  std::vector<DrawnBar> bars;
};

struct BarPicture {
  std::string title;
  std::string x_label;
  std::vector<BarGroup> groups;
  std::optional<double> mark;  // a value to compare with, as a line through all groups
  std::string mark_label;
  bool logarithmic = false;    // decades from `least` on
  double least = 1.0;
  double width_px = 900.0;     // the height follows from the bars
};

std::string bar_picture(const BarPicture& picture);

}  // namespace odolab
