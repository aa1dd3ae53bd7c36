#include "core/calibration/rests.h"

#include <algorithm>

namespace odolab {

std::vector<Movement> movements(const std::vector<WheelSample>& readings, double WheelSample::*wheel) {
  constexpr double kLongestSlow_s = 1.0, kAsLong = 1.7;
  std::vector<Movement> all;
  const int n = static_cast<int>(readings.size()) - 1;
  for (int i = 0; i < n; ++i)
    if (const double by = readings[i + 1].*wheel - readings[i].*wheel; by != 0.0) all.push_back({i, by, false});
  const auto waits_s = [&](std::size_t m) {
    return readings[all[m + 1].interval].time_s - readings[all[m].interval + 1].time_s;
  };
  const auto goes_on = [&](std::size_t m) { return all[m].by * all[m + 1].by > 0.0; };
  for (std::size_t m = 0; m + 1 < all.size(); ++m) {
    const double wait_s = waits_s(m);
    if (wait_s <= kRest_s) continue;
    all[m].then_rests = true;
    if (wait_s > kLongestSlow_s || !goes_on(m)) continue;
    for (const std::size_t beside : {m - 1, m + 1})
      if (beside < all.size() - 1 && goes_on(beside) && wait_s <= kAsLong * waits_s(beside) &&
          waits_s(beside) <= kAsLong * wait_s)
        all[m].then_rests = false;
  }
  return all;
}

std::vector<RestEdge> rest_edges(const std::vector<WheelSample>& readings, double WheelSample::*wheel) {
  std::vector<RestEdge> edges;
  const std::vector<Movement> all = movements(readings, wheel);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const double direction = all[m].by < 0.0 ? -1.0 : 1.0;
    if (m + 1 < all.size()) {
      if (!all[m].then_rests) continue;
      edges.push_back({all[m].interval, false, direction});
      edges.push_back({all[m + 1].interval, true, direction});
    } else if (readings.back().time_s - readings[static_cast<std::size_t>(all[m].interval) + 1].time_s > kRest_s) {
      edges.push_back({all[m].interval, false, direction});
    }
  }
  return edges;
}

}  // namespace odolab
