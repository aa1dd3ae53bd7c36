// Frames that have time for all that is to be done.
#pragma once

namespace odolab {

inline const auto kAlways = [] { return true; };

}  // namespace odolab
