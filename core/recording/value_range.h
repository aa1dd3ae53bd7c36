// Which values no robot has, so that a file which holds one is at fault.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/recording/recording.h"

namespace odolab {

// What a channel lies within, either side of zero, by the unit in its name: twice around the Earth, what turns a
// thousand times a second for two days, a counter of 64 bits. Infinity where the name has no such unit.
double largest_value(std::string_view channel);

// In words: "a number from -1e+08 to 1e+08 (m)".
std::string range_text(std::string_view channel);

// The first value beyond it: the channel and its row, what was found and what was expected.
std::optional<Error> value_beyond_range(const Recording& recording);

}  // namespace odolab
