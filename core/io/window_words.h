// Over which way an error was gathered, in words.
#pragma once

#include <string>

#include "core/geometry/window_size.h"

namespace odolab {

// "over each metre or radian"; "from one pose of the truth to the next, 24 m and 31 rad in the median" where windows
// are longer than that.
std::string over_which_way(const WindowSize& window);

}  // namespace odolab
