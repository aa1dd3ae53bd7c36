// A way on the floor with a size at each of its points, ready to be drawn at any zoom: a long one costs no more than a
// short one.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/geometry/pose.h"
#include "ui/floor/camera.h"
#include "ui/look/theme.h"

namespace odolab::ui {

// From one time to another.
using Stretch = std::pair<double, double>;

class Trail {
 public:
  Trail() = default;
  // All of one length; `size` may be empty. Points that are not finite are left out.
  Trail(std::vector<double> time_s, const std::vector<double>& x_m, const std::vector<double>& y_m,
        const std::vector<double>& size = {});

  struct Point {
    double time_s = 0.0;
    Vec2 at;
    float size = 0.0f;  // the largest of the points that it stands for
  };
  // The points that are this far apart or more, or all where that is not far: a kept one stands for those before it.
  const std::vector<Point>& points(double apart_m) const;

  bool empty() const { return levels_.empty() || levels_.front().points.empty(); }
  Vec2 lowest() const { return lowest_; }
  Vec2 highest() const { return highest_; }
  // When it is inside the rectangle between two corners; stretches less than `join_s` apart are one.
  std::vector<Stretch> inside(Vec2 a, Vec2 b, double join_s = 0.3) const;

 private:
  struct Level {
    double apart_m = 0.0;
    std::vector<Point> points;
  };
  std::vector<Level> levels_;
  Vec2 lowest_, highest_;
};

// In one colour.
void draw_trail(ImDrawList& draw, const Camera& camera, const Trail& trail, ImU32 colour, float width,
                const Theme& theme);
// Coloured by size, core/diagnosis/mismatch.h's scale; where `lit` is not empty, what is outside of it is faint.
void draw_mismatch(ImDrawList& draw, const Camera& camera, const Trail& trail, const std::vector<Stretch>& lit,
                   const Theme& theme);
ImU32 mismatch_colour(int level, const Theme& theme);
float mismatch_width(int level, const Theme& theme);

}  // namespace odolab::ui
