#include "core/geometry/window_size.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace odolab {

std::vector<WindowSize> window_sizes(const Track& estimate, const TrackError& error) {
  constexpr double kStride_m = 0.01, kStride_rad = 0.03;  // as windows are counted: what trembles does not travel
  std::vector<WindowSize> sizes;
  for (const auto& [from_s, to_s] : error.window_s) {
    WindowSize size;
    auto at = std::lower_bound(estimate.begin(), estimate.end(), from_s,
                               [](const TimedPose& p, double t) { return p.time_s < t; });
    for (auto counted = at; at != estimate.end() && at->time_s <= to_s; ++at) {
      const double stride_m = length(at->pose.position() - counted->pose.position());
      const double stride_rad = std::abs(wrapped(at->pose.heading_rad - counted->pose.heading_rad));
      if (stride_m <= kStride_m && stride_rad <= kStride_rad) continue;
      size.way_m += stride_m;
      size.turn_rad += stride_rad;
      counted = at;
    }
    sizes.push_back(size);
  }
  return sizes;
}

WindowSize median_of(const std::vector<WindowSize>& windows) {
  std::vector<double> ways_m, turns_rad;
  for (const WindowSize& w : windows) ways_m.push_back(w.way_m), turns_rad.push_back(w.turn_rad);
  return {median(ways_m), median(turns_rad)};
}

}  // namespace odolab
