// Rotation of both wheels at any time: linear or bent between samples, linear beyond the ends.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/recording/vehicle_samples.h"

namespace odolab {

struct WheelRates {
  double left_radps = 0.0, right_radps = 0.0;
};

class WheelLine {
 public:
  WheelLine(const std::vector<WheelSample>& wheels, bool held) : wheels_(wheels), held_(held) {}
  // The interval that holds the time: i for [i, i + 1]. Times are asked for in order.
  std::size_t interval_at(double time_s) {
    while (i_ + 2 < wheels_.size() && wheels_[i_ + 1].time_s <= time_s) ++i_;
    return i_;
  }
  // At a time within interval i: the derivative of turned_rad.
  WheelRates rates(std::size_t i, double time_s) const {
    const WheelSample &a = wheels_[i], &b = wheels_[i + 1];
    const double dt = b.time_s - a.time_s, u = (time_s - a.time_s) / dt;
    const WheelRates even{(b.left_rad - a.left_rad) / dt, (b.right_rad - a.right_rad) / dt};
    if (held_ || u < 0.0 || u > 1.0) return even;
    const auto bent = [&](double by, double slope_a, double slope_b) {
      if (by == 0.0) return 0.0;
      return (3.0 * u * u - 4.0 * u + 1.0) * slope_a + 6.0 * (u - u * u) * by + (3.0 * u * u - 2.0 * u) * slope_b;
    };
    const WheelRates at_a = slope(i), at_b = slope(i + 1);
    return {bent(even.left_radps, at_a.left_radps, at_b.left_radps),
            bent(even.right_radps, at_a.right_radps, at_b.right_radps)};
  }
  // Rotation of each wheel since sample i, at a time within the interval behind it.
  std::pair<double, double> turned_rad(std::size_t i, double time_s) const {
    const WheelSample &a = wheels_[i], &b = wheels_[i + 1];
    const double dt = b.time_s - a.time_s, u = (time_s - a.time_s) / dt;
    const double left = b.left_rad - a.left_rad, right = b.right_rad - a.right_rad;
    if (held_ || u <= 0.0 || u >= 1.0) return {u * left, u * right};
    // A wheel that speeds up lags behind the straight line between two samples. Cubic, slopes from both neighbours.
    const auto bent = [&](double by, double slope_a, double slope_b) {
      if (by == 0.0) return 0.0;
      const double u2 = u * u, u3 = u2 * u;
      return (u3 - 2.0 * u2 + u) * dt * slope_a + (3.0 * u2 - 2.0 * u3) * by + (u3 - u2) * dt * slope_b;
    };
    const WheelRates at_a = slope(i), at_b = slope(i + 1);
    return {bent(left, at_a.left_radps, at_b.left_radps), bent(right, at_a.right_radps, at_b.right_radps)};
  }

 private:
  WheelRates slope(std::size_t i) const {
    const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, wheels_.size() - 1);
    const double dt = wheels_[after].time_s - wheels_[before].time_s;
    return {(wheels_[after].left_rad - wheels_[before].left_rad) / dt,
            (wheels_[after].right_rad - wheels_[before].right_rad) / dt};
  }

  const std::vector<WheelSample>& wheels_;
  bool held_;
  std::size_t i_ = 0;
};
}  // namespace odolab
