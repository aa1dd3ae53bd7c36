#include "ui/floor/camera.h"

#include <algorithm>

namespace odolab::ui {

namespace {

constexpr double kLeast = 0.5, kMost = 200000.0;  // pixels per metre: a hall of a kilometre, a wheel's contact

}  // namespace

void Camera::zoom(ImVec2 at, double factor) {
  const Vec2 before = floor(at);
  px_per_m = std::clamp(px_per_m * factor, kLeast, kMost);
  centre = centre + (before - floor(at));
}

void Camera::fit(Vec2 lowest, Vec2 highest, const Margins& margins) {
  const double w = std::max(highest.x_m - lowest.x_m, 0.2), h = std::max(highest.y_m - lowest.y_m, 0.2);
  const double room_x = std::max(20.0, high.x - low.x - margins.left - margins.right),
               room_y = std::max(20.0, high.y - low.y - margins.top - margins.bottom);
  px_per_m = std::clamp(std::min(room_x / w, room_y / h), kLeast, kMost);
  const Vec2 off_middle{0.5 * (margins.right - margins.left) / px_per_m,
                        0.5 * (margins.top - margins.bottom) / px_per_m};
  centre = 0.5 * (lowest + highest) + off_middle;
}

}  // namespace odolab::ui
