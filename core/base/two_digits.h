// A size in a sentence.
#pragma once

#include <cmath>
#include <string>

#include "core/base/formatted.h"

namespace odolab {

// "0.0034", "12", "1250": two digits, but never an exponent for what is large.
inline std::string two_digits(double size) { return formatted(std::abs(size) < 99.5 ? "%.2g" : "%.0f", size); }

}  // namespace odolab
