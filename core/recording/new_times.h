// Rows of a recording, moved in time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// New times of the rows that hold a value of the channels that belong together; NaN elsewhere.
struct NewTimes {
  std::function<bool(const std::string&)> belongs;
  std::vector<double> time_s;
};

// The same values with the new times, in order of time: a row of which only some channels move becomes two.
Recording with_new_times(const Recording& old, const std::vector<NewTimes>& moved);

}  // namespace odolab
