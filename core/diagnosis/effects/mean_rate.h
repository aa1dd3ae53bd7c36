// What goes by the steps of a drive, in the mean about each of them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

// Per second, over the steps that begin within `half_window_s` to either side; `of_step`: what one step has of it.
template <class OfStep>
std::vector<double> mean_rate(const DriveView& view, double half_window_s, const OfStep& of_step) {
  std::vector<double> rate;
  double sum = 0.0, lasted_s = 0.0;
  std::size_t first = 0, end = 0;
  for (const EffectStep& s : view.steps) {
    for (; end < view.steps.size() && view.steps[end].time_s <= s.time_s + half_window_s; ++end)
      sum += of_step(view.steps[end]), lasted_s += view.steps[end].duration_s;
    for (; view.steps[first].time_s < s.time_s - half_window_s; ++first)
      sum -= of_step(view.steps[first]), lasted_s -= view.steps[first].duration_s;
    rate.push_back(lasted_s > 0.0 ? sum / lasted_s : 0.0);
  }
  return rate;
}

}  // namespace odolab::effects
