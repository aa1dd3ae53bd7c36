// What wheels read at any time.
#pragma once

#include <algorithm>
#include <vector>

#include "core/recording/recording.h"

namespace odolab {

// The samples between which a time lies, `after` and the one before it, and how far on its way from one to the other:
// 0 before the first sample, 1 behind the last.
struct PlaceBetween {
  std::size_t after = 1;
  double share = 0.0;
};

// Among two samples or more in order of time, by bisection. Of several at one time the earliest counts.
template <typename Sample>
PlaceBetween place_between(const std::vector<Sample>& samples, double time_s) {
  const auto after = std::lower_bound(samples.begin() + 1, samples.end() - 1, time_s,
                                      [](const Sample& s, double t) { return s.time_s < t; });
  const double from_s = (after - 1)->time_s, span_s = after->time_s - from_s;
  return {static_cast<std::size_t>(after - samples.begin()),
          span_s > 0.0 ? std::clamp((time_s - from_s) / span_s, 0.0, 1.0) : 0.0};
}

// The rotation of both wheels at a time, linear between two readings; before the first and behind the last of them they
// rest. Two readings or more, in order of time.
WheelSample wheels_at(const std::vector<WheelSample>& wheels, double time_s);

}  // namespace odolab
