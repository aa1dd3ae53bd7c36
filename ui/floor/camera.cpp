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

void Camera::fit(Vec2 lowest, Vec2 highest, double air_px) {
  centre = 0.5 * (lowest + highest);
  const double w = std::max(highest.x_m - lowest.x_m, 0.2), h = std::max(highest.y_m - lowest.y_m, 0.2);
  const double room_x = std::max(20.0, high.x - low.x - 2.0 * air_px), room_y = std::max(20.0, high.y - low.y - 2.0 * air_px);
  px_per_m = std::clamp(std::min(room_x / w, room_y / h), kLeast, kMost);
}

}  // namespace odolab::ui
