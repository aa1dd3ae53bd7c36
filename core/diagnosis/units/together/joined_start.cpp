// Where a filter begins.
#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/diagnosis/units/together/joined_filter.h"

namespace odolab {

namespace {

// The turn and shift that lay one row of places best upon another, by those that it brings near: of the others, a
// radio's outliers, one alone may be a metre off.
Pose laid_upon(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  constexpr int kTimes = 4;
  constexpr double kNear = 3.0;  // of the median distance
  std::vector<char> is_near(from.size(), 1);
  Pose laid;
  for (int time = 0; time < kTimes; ++time) {
    Vec2 mean_from{}, mean_to{};
    double n = 0.0, cosine = 0.0, sine = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (is_near[i]) mean_from = mean_from + from[i], mean_to = mean_to + to[i], n += 1.0;
    mean_from = (1.0 / n) * mean_from;
    mean_to = (1.0 / n) * mean_to;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (is_near[i]) {
        cosine += dot(from[i] - mean_from, to[i] - mean_to);
        sine += cross(from[i] - mean_from, to[i] - mean_to);
      }
    const double turn_rad = std::atan2(sine, cosine);
    const Vec2 shift = mean_to - rotated(mean_from, turn_rad);
    laid = {shift.x_m, shift.y_m, turn_rad};
    std::vector<double> off_m;
    for (std::size_t i = 0; i < from.size(); ++i) off_m.push_back(length(laid * from[i] - to[i]));
    const double near_m = kNear * median(off_m);
    for (std::size_t i = 0; i < from.size(); ++i) is_near[i] = off_m[i] <= near_m;
  }
  return laid;
}

}  // namespace

Pose JoinedFilter::started_at() const {
  const auto by_wheels = [&](const Reading& r) { return on_the_way(way_[0], r.time_s) * r.unit_T_body[0]; };
  const Pose first = by_wheels(readings_.front());
  if (truth_rows_ == 3) {
    const auto seen = std::find_if(readings_.begin(), readings_.end(), [](const Reading& r) { return !!r.truth; });
    return *seen->truth * between(by_wheels(*seen), first);
  }
  // Positions alone: as the first unit's way lies best upon them, while it is too short to have gone astray.
  constexpr double kFew_m = 3.0, kFarEnough_m = 1.0;
  std::vector<Vec2> way, truth;
  double gone_m = 0.0, furthest_m = 0.0;
  for (const Reading& reading : readings_) {
    if (!reading.truth) continue;
    way.push_back(by_wheels(reading).position());
    truth.push_back(reading.truth->position());
    if (way.size() > 1) gone_m += length(way.back() - way[way.size() - 2]);
    furthest_m = std::max(furthest_m, length(way.back() - way.front()));
    if (gone_m > kFew_m && furthest_m > kFarEnough_m) break;
  }
  const Pose room_T_way = laid_upon(way, truth);
  return room_T_way * first;
}

}  // namespace odolab
