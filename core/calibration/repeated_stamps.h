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
template <typename Reading>
std::vector<Reading> without_repeated(const std::vector<Reading>& readings) {
  std::vector<Reading> kept;
  for (const Reading& r : readings)
    if (kept.empty() || r.time_s > kept.back().time_s) kept.push_back(r);
  return kept;
}

}  // namespace odolab
