#include "core/io/picture/floor_view.h"

#include <algorithm>
#include <cmath>

#include "core/io/picture/axis.h"

namespace odolab {

void FloorBox::include(Vec2 p) {
  if (!std::isfinite(p.x_m) || !std::isfinite(p.y_m)) return;
  left = std::min(left, p.x_m);
  right = std::max(right, p.x_m);
  low = std::min(low, p.y_m);
  high = std::max(high, p.y_m);
}

FloorView::FloorView(FloorBox shown, Point corner_px, double width, double height)
    : box(shown), corner(corner_px), width_px(width), height_px(height) {
  if (box.empty()) box.include({0.0, 0.0});
  // a robot's width of air, and never less than half a metre across
  const double air = std::max({0.3, 0.06 * (box.right - box.left), 0.06 * (box.high - box.low)});
  box = {box.left - air, box.right + air, box.low - air, box.high + air};
  scale_px = std::min(width_px / (box.right - box.left), height_px / (box.high - box.low));
  // the floor fills the picture: what is left over on one axis is shown too
  const double more_x = 0.5 * (width_px / scale_px - (box.right - box.left));
  const double more_y = 0.5 * (height_px / scale_px - (box.high - box.low));
  box = {box.left - more_x, box.right + more_x, box.low - more_y, box.high + more_y};
}

void FloorView::draw_grid(Svg& svg) const {
  const double step_m = scale_px < 12.0 || scale_px > 400.0 ? round_step(width_px / scale_px, 10) : 1.0;
  for (double k = std::ceil(box.left / step_m); k * step_m <= box.right; k += 1.0)
    svg.line(at({k * step_m, box.low}), at({k * step_m, box.high}), {ink::kGrid, 1.0, ""});
  for (double k = std::ceil(box.low / step_m); k * step_m <= box.high; k += 1.0)
    svg.line(at({box.left, k * step_m}), at({box.right, k * step_m}), {ink::kGrid, 1.0, ""});
}

void FloorView::draw_scale_bar(Svg& svg, Point right_end, int parts) const {
  const double length_m = round_step(width_px / scale_px, parts);
  const double right = right_end.x, y = right_end.y, left = right - length_m * scale_px;
  svg.line({left, y}, {right, y}, {ink::kText, 2.0, ""});
  svg.line({left, y - 4}, {left, y + 4}, {ink::kText, 2.0, ""});
  svg.line({right, y - 4}, {right, y + 4}, {ink::kText, 2.0, ""});
  svg.text({0.5 * (left + right), y - 8}, tick_text(length_m, length_m) + " m", Anchor::middle);
}

void FloorView::draw_start(Svg& svg, const Pose& start) const {
  const Point p = at(start.position());
  const auto corner_at = [&](double ahead, double to_the_left) {
    const Vec2 d = rotated({ahead, to_the_left}, start.heading_rad);
    return Point{p.x + d.x_m, p.y - d.y_m};
  };
  svg.polygon({corner_at(15, 0), corner_at(-8, 8), corner_at(-4, 0), corner_at(-8, -8)}, "#ffffff", {ink::kTruth, 1.6, ""});
}

}  // namespace odolab
