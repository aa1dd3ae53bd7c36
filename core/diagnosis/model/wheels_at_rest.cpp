#include "core/diagnosis/model/wheels_at_rest.h"

#include <algorithm>

namespace odolab {

bool wheels_stand(const EffectStep& step) { return step.left_read_rad == 0.0 && step.right_read_rad == 0.0; }

std::vector<Rest> rests(const DriveView& view) {
  std::vector<Rest> found;
  for (std::size_t i = 0; i < view.steps.size();) {
    std::size_t j = i;
    while (j < view.steps.size() && wheels_stand(view.steps[j])) ++j;
    if (j > i) {
      const EffectStep &first = view.steps[i], &last = view.steps[j - 1];
      found.push_back({i, j, first.time_s - 0.5 * first.duration_s, last.time_s + 0.5 * last.duration_s});
    }
    i = std::max(i + 1, j);
  }
  return found;
}

}  // namespace odolab
