#include "core/diagnosis/effects/reversals.h"

#include <cmath>

namespace odolab {

std::vector<Reversal> reversals(const DriveView& view) {
  std::vector<Reversal> found;
  double travelled_m = 0.0, furthest_m = 0.0;
  std::size_t furthest = 0;
  int direction = 0;  // not known yet
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    travelled_m += view.steps[i].forward_m();
    const double back_m = direction * (furthest_m - travelled_m);
    const bool reverses = direction != 0 && back_m > kReversed_m;
    if (reverses) {
      direction = -direction;
      found.push_back({furthest, i, direction, back_m});
    }
    if (direction == 0 || reverses || back_m <= 0.0) {
      furthest_m = travelled_m;
      furthest = i + 1;
    }
    if (direction == 0 && std::abs(travelled_m) > kReversed_m) direction = travelled_m > 0.0 ? 1 : -1;
  }
  return found;
}

}  // namespace odolab
