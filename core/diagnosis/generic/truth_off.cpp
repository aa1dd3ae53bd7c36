#include "core/diagnosis/generic/truth_off.h"

#include <utility>

namespace odolab {

std::vector<Motions> motions_of_truth_off(const DriveView& view, const TruthOffsets& offsets, std::size_t count) {
  std::vector<Motions> out(count, Motions(view.steps.size()));
  std::vector<TruthOff> now(count), before(count);
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    offsets(view.number, s, now);
    for (std::size_t k = 0; k < count && i > 0; ++k) {
      const Vec2 by = now[k].by - before[k].by;
      out[k][i] = {s.cos_heading * by.x_m + s.sin_heading * by.y_m,
                   s.cos_heading * by.y_m - s.sin_heading * by.x_m - now[k].turned_rad * s.forward_m(),
                   now[k].turned_rad - before[k].turned_rad};
    }
    std::swap(now, before);
  }
  return out;
}

}  // namespace odolab
