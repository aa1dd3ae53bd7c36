#include "core/diagnosis/units/laid_stretch.h"

namespace odolab {

LaidStretch laid_stretch(const std::vector<Pose>& by_joints, const std::vector<Pose>& by_wheels) {
  const double n = static_cast<double>(by_joints.size());
  const double first_rad = by_joints[0].heading_rad - by_wheels[0].heading_rad;
  double turned_rad = 0.0;
  for (std::size_t k = 0; k < by_joints.size(); ++k)
    turned_rad += wrapped(by_joints[k].heading_rad - by_wheels[k].heading_rad - first_rad) / n;
  turned_rad += first_rad;
  std::vector<Vec2> off;
  Vec2 mean;
  for (std::size_t k = 0; k < by_joints.size(); ++k) {
    off.push_back(rotated(by_joints[k].position(), -turned_rad) - by_wheels[k].position());
    mean = mean + (1.0 / n) * off.back();
  }
  const Vec2 moved = rotated(mean, turned_rad);
  LaidStretch laid{{moved.x_m, moved.y_m, turned_rad}, {}};
  for (std::size_t k = 0; k < by_joints.size(); ++k) {
    const Vec2 rest = rotated(off[k] - mean, -by_wheels[k].heading_rad);
    laid.rest.emplace_back(rest.x_m, rest.y_m,
                           wrapped(by_joints[k].heading_rad - by_wheels[k].heading_rad - turned_rad));
  }
  return laid;
}

}  // namespace odolab
