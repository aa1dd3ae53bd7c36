// What the columns of every derivative stand for: the vehicle file's keys and their units.
#pragma once

#include <array>
#include <string_view>

#include "core/calibration/innovations.h"

namespace odolab::column {

struct Name {
  const char* key;
  const char* unit;
};
constexpr std::array<Name, first_extra> names = {{{"wheel_radius_left_m", "m"},
                                                  {"wheel_radius_right_m", "m"},
                                                  {"wheelbase_m", "m"},
                                                  {"truth_mounting.x_m", "m"},
                                                  {"truth_mounting.y_m", "m"},
                                                  {"truth_mounting.heading_rad", "rad"},
                                                  {"truth_mounting.time_offset_s", "s"}}};

// The column of that key; -1 where there is none.
constexpr int of_key(std::string_view key) {
  for (int c = 0; c < first_extra; ++c)
    if (names[static_cast<std::size_t>(c)].key == key) return c;
  return -1;
}

}  // namespace odolab::column
