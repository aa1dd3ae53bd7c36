#include "core/geometry/window_size.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"

namespace odolab {

std::vector<WindowSize> window_sizes(const Track& estimate, const TrackError& error) {
  constexpr double kStride_m = 0.05, kStride_rad = 0.2;  // whole counts that come in turn are no way and no turn
  std::vector<WindowSize> sizes;
  for (const auto& [from_s, to_s] : error.window_s) {
    WindowSize size;
    auto at = std::lower_bound(estimate.begin(), estimate.end(), from_s,
                               [](const TimedPose& p, double t) { return p.time_s < t; });
    double stride_m = 0.0, stride_rad = 0.0;
    for (auto here = at, turned = at; at != estimate.end() && at->time_s <= to_s; ++at) {
      stride_m = length(at->pose.position() - here->pose.position());
      stride_rad = std::abs(wrapped(at->pose.heading_rad - turned->pose.heading_rad));
      if (stride_m > kStride_m) size.way_m += std::exchange(stride_m, 0.0), here = at;
      if (stride_rad > kStride_rad) size.turn_rad += std::exchange(stride_rad, 0.0), turned = at;
    }
    size.way_m += stride_m;
    size.turn_rad += stride_rad;
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
