#include "core/recording/same_samples.h"

#include <cmath>

namespace odolab {

bool same_samples(const Recording& a, const Recording& b) {
  if (a.time_s != b.time_s || a.channels.size() != b.channels.size()) return false;
  for (std::size_t c = 0; c < a.channels.size(); ++c)
    for (std::size_t i = 0; i < a.time_s.size(); ++i) {
      const double x = a.channels[c].values[i], y = b.channels[c].values[i];
      if (x != y && !(std::isnan(x) && std::isnan(y))) return false;
    }
  return true;
}

}  // namespace odolab
