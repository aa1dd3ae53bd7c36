#include "core/recording/same_samples.h"

#include <algorithm>
#include <cmath>

namespace odolab {

bool same_samples(const Recording& a, const Recording& b) {
  if (a.time_s != b.time_s || a.channels.size() != b.channels.size()) return false;
  const auto is_same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    const Channel &of_a = a.channels[c], &of_b = b.channels[c];
    if (of_a.name != of_b.name ||
        !std::equal(of_a.values.begin(), of_a.values.end(), of_b.values.begin(), of_b.values.end(), is_same))
      return false;
  }
  return true;
}

}  // namespace odolab
