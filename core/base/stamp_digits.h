// How well a stamp is known.
#pragma once

namespace odolab {

// Of a stamp as it is written, and as a double holds one of these days: times that differ by less are alike, whatever
// their last digit makes of them.
inline constexpr double kStampDigits_s = 1e-6;

}  // namespace odolab
