// An absolute encoder: it reads the middle of the cell that the angle or length lies in.
#pragma once

#include <cmath>

namespace odolab {

// `resolution` 0: continuous.
inline double quantised(double value, double resolution) {
  return resolution > 0.0 ? resolution * std::floor(value / resolution + 0.5) : value;
}

}  // namespace odolab
