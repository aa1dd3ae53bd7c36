#include "core/calibration/rests.h"

namespace odolab {

std::vector<RestEdge> rest_edges(const std::vector<WheelSample>& readings, double WheelSample::*wheel) {
  std::vector<RestEdge> edges;
  int moved = -1;
  double direction = 1.0;
  const int n = static_cast<int>(readings.size()) - 1;
  for (int i = 0; i <= n; ++i) {
    const double by = i < n ? readings[i + 1].*wheel - readings[i].*wheel : 0.0;
    if (by == 0.0 && i < n) continue;
    if (moved >= 0 && readings[i].time_s - readings[moved + 1].time_s > kRest_s) {
      edges.push_back({moved, false, direction});
      if (i < n) edges.push_back({i, true, direction});
    }
    moved = i;
    direction = by < 0.0 ? -1.0 : 1.0;
  }
  return edges;
}

}  // namespace odolab
