// One biased encoder among several whose offsets trade for each other.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

struct LoneBias {
  std::size_t joint = 0;                 // of the fit's
  double off = 0.0, stderr_value = 0.0;  // from the file, were all other encoders right
  std::vector<std::string> others;       // which are
};

// The encoder of a link whose offset alone says what those of all encoders say together: what these say beyond it is
// chance (p > 0.01), and of no other encoder is that so by 10 in twice the log-likelihood. With all of them free at
// once none may be known well, though one of them is there beyond doubt: of links with angles at both ends a path of
// wide bends shows the difference of both ten times better than either. Nothing where offsets are known otherwise than
// by the fit's covariance, of pivots, of which any may be the body's, or where one alone is asked for.
std::optional<LoneBias> lone_bias(const GeometryFit& geometry);

}  // namespace odolab
