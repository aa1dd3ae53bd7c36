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
  double turned_rad = 0.0;               // of pivots: by how much all read more, which is a turn of the body's x axis
  std::vector<std::string> others;       // which are right
  struct Instead {
    std::size_t joint = 0;
    double gain = 0.0;  // in twice the log-likelihood
  };
  std::vector<Instead> instead;  // encoders that alone would say what all say, too
};

// The encoder of a joint whose offset alone says what those of all encoders say together: what these say beyond it is
// chance (p > 0.01). With all of them free at once none may be known well, though one of them is there beyond doubt: of
// links with angles at both ends a path of wide bends shows the difference of both ten times better than either. Pivots
// are held against each other alone, three or more, since what all of them read more is the body's. Another that is not
// beaten by 10 in twice the log-likelihood may be the one instead, of the same sort. Nothing where the fit's covariance
// is not known, or where one alone is asked for.
std::optional<LoneBias> lone_bias(const GeometryFit& geometry);

}  // namespace odolab
