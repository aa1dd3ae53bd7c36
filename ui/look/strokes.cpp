#include "ui/look/strokes.h"

#include <algorithm>
#include <cmath>

namespace odolab::ui {

void solid_line(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 colour, float width) {
  constexpr std::size_t kMost = 4000;  // a thick line of about 16 000 points is drawn corrupted
  for (std::size_t i = 0; i + 1 < points.size(); i += kMost)
    draw.AddPolyline(points.data() + i, int(std::min(kMost + 1, points.size() - i)), colour, 0, width);
}

void dashed_line(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 colour, float width, float dash,
                 float gap) {
  const ImVec2 low = draw.GetClipRectMin(), high = draw.GetClipRectMax();
  const float period = dash + gap;
  float along = 0.0f;
  std::vector<ImVec2> stroke;
  const auto finish = [&] {
    if (stroke.size() > 1) draw.AddPolyline(stroke.data(), int(stroke.size()), colour, 0, width);
    stroke.clear();
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const ImVec2 a = points[i], b = points[i + 1];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    const bool outside = std::max(a.x, b.x) < low.x || std::min(a.x, b.x) > high.x || std::max(a.y, b.y) < low.y ||
                         std::min(a.y, b.y) > high.y;
    if (length <= 0.0f) continue;
    if (outside || length > 1e5f) {
      finish();
      along = std::fmod(along + length, period);
      continue;
    }
    float done = 0.0f;
    while (done < length) {
      const bool on = along < dash;
      const float stretch = std::min(length - done, (on ? dash : period) - along);
      const auto at = [&](float s) { return ImVec2(a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length); };
      if (on) {
        if (stroke.empty()) stroke.push_back(at(done));
        stroke.push_back(at(done + stretch));
      }
      done += stretch;
      along += stretch;
      if (on && along >= dash - 1e-4f) finish();
      if (along >= period - 1e-4f) along = 0.0f;
      if (stretch <= 0.0f) break;
    }
  }
  finish();
}

}  // namespace odolab::ui
