// The floor seen from above, at one scale for both axes: what the pictures of tracks share.
#pragma once

#include <limits>
#include <vector>

#include "core/geometry/pose.h"
#include "core/io/picture/svg.h"

namespace odolab {

// Metres of floor.
struct FloorBox {
  double left = std::numeric_limits<double>::infinity(), right = -left, low = left, high = -left;

  void include(Vec2 p);  // points that are not finite are passed over
  bool empty() const { return !(left <= right); }
};

// A frame of the picture that shows a box and as much more as fills it.
struct FloorView {
  FloorView(FloorBox shown, Point corner, double width, double height);

  Point at(Vec2 p) const { return {corner.x + (p.x_m - box.left) * scale_px, corner.y + (box.high - p.y_m) * scale_px}; }
  // Lines every metre, unless that would be a net too fine or one line alone.
  void draw_grid(Svg& svg) const;
  // A bar of round length, about one of so many parts of the width, whose right end is at a point.
  void draw_scale_bar(Svg& svg, Point right_end, int parts = 5) const;
  void draw_start(Svg& svg, const Pose& start) const;

  FloorBox box;
  Point corner;
  double width_px, height_px;
  double scale_px = 1.0;  // of a metre
};

}  // namespace odolab
