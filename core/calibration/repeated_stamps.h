// Stamps that repeat the one before, of readings that were taken later or sooner.
#pragma once

#include <optional>
#include <vector>

#include "core/recording/recording.h"

namespace odolab {

struct SpreadStamps {
  std::vector<double> time_s;  // one for each stamp given
  int repeated = 0;            // how many were put elsewhere
};

// Readings that share a stamp, put apart evenly: over the gap behind it, or that before it, where this is longer than
// the usual gap by as many periods as there are readings too many. Nothing where none is. `time_s` never decreases.
std::optional<SpreadStamps> spread_repeated(const std::vector<double>& time_s);

// Those whose stamp is later than that of the one before.
std::vector<WheelSample> without_repeated(const std::vector<WheelSample>& readings);

}  // namespace odolab
