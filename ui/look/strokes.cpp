#include "ui/look/strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace odolab::ui {

namespace {

// The part of the way from a to b, as shares of it, that lies in a rectangle with so much air around; empty where none.
std::pair<float, float> inside(ImVec2 a, ImVec2 b, ImVec2 low, ImVec2 high, float air) {
  float enters = 0.0f, leaves = 1.0f;
  const auto cut = [&](float from, float to, float least, float most) {
    const float by = to - from;
    if (by == 0.0f) {
      if (from < least || from > most) leaves = 0.0f;
      return;
    }
    const float first = (by > 0.0f ? least - from : most - from) / by;
    const float last = (by > 0.0f ? most - from : least - from) / by;
    enters = std::max(enters, first);
    leaves = std::min(leaves, last);
  };
  cut(a.x, b.x, low.x - air, high.x + air);
  cut(a.y, b.y, low.y - air, high.y + air);
  return {enters, leaves};
}

}  // namespace

void solid_line(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 colour, float width) {
  constexpr std::size_t kMost = 4000;  // a thick line of about 16 000 points is drawn corrupted
  const ImVec2 low = draw.GetClipRectMin(), high = draw.GetClipRectMax();
  const auto in_sight = [&](std::size_t i) {  // the piece that begins at this point, with the corners at its ends
    const auto [enters, leaves] = inside(points[i], points[i + 1], low, high, 2.0f * width);
    return enters <= leaves;
  };
  for (std::size_t i = 0; i + 1 < points.size();) {
    if (!in_sight(i)) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (end + 1 < points.size() && end - i < kMost && in_sight(end)) ++end;
    draw.AddPolyline(points.data() + i, int(end - i + 1), colour, 0, width);
    i = end;
  }
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
    if (length <= 0.0f) continue;
    // Of a long piece only what is in sight: a lens may enlarge it a thousand times.
    const auto [enters, leaves] = inside(a, b, low, high, width);
    if (enters >= leaves || length > 1e6f) {  // beyond that floats know no dashes
      finish();
      along = std::fmod(along + length, period);
      continue;
    }
    if (enters > 0.0f) finish();
    along = std::fmod(along + enters * length, period);
    float done = enters * length;
    while (done < leaves * length) {
      const bool on = along < dash;
      const float stretch = std::min(leaves * length - done, (on ? dash : period) - along);
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
    if (leaves < 1.0f) finish();
    along = std::fmod(along + (1.0f - leaves) * length, period);
  }
  finish();
}

}  // namespace odolab::ui
