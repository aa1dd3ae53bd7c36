// From metres on the floor to pixels on the screen and back: y up, x to the right.
#pragma once

#include <imgui.h>

#include "core/geometry/pose.h"

namespace odolab::ui {

struct Camera {
  Vec2 centre;  // the floor's point in the middle of the canvas
  double px_per_m = 100.0;
  ImVec2 low, high;  // the canvas on the screen

  ImVec2 screen(Vec2 p) const {
    return {0.5f * (low.x + high.x) + float((p.x_m - centre.x_m) * px_per_m),
            0.5f * (low.y + high.y) - float((p.y_m - centre.y_m) * px_per_m)};
  }
  Vec2 floor(ImVec2 at) const {
    return {centre.x_m + (at.x - 0.5 * (low.x + high.x)) / px_per_m,
            centre.y_m - (at.y - 0.5 * (low.y + high.y)) / px_per_m};
  }
  double width_m() const { return (high.x - low.x) / px_per_m; }
  double height_m() const { return (high.y - low.y) / px_per_m; }

  // Zooms so that the point under `at` stays where it is.
  void zoom(ImVec2 at, double factor);
  // Shows the rectangle between two corners inside margins of the canvas.
  struct Margins {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  };
  void fit(Vec2 lowest, Vec2 highest, const Margins& margins_px);
};

}  // namespace odolab::ui
