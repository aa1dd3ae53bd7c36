// How far a way turns from one side to the other.
#pragma once

#include <algorithm>

namespace odolab {

// Of steps, each of which turns by its `turn_rad`: the largest heading less the smallest, in rad.
template <typename Steps>
double heading_range_rad(const Steps& steps) {
  double turned_rad = 0.0, least_rad = 0.0, most_rad = 0.0;
  for (const auto& step : steps) {
    turned_rad += step.turn_rad;
    least_rad = std::min(least_rad, turned_rad);
    most_rad = std::max(most_rad, turned_rad);
  }
  return most_rad - least_rad;
}

}  // namespace odolab
