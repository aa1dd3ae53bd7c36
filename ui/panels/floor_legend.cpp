#include "ui/panels/floor_legend.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/diagnosis/mismatch.h"
#include "ui/floor/drawing.h"
#include "ui/look/strokes.h"
#include "ui/look/units.h"

namespace odolab::ui {

namespace {

// Returns where the next line of the legend may begin.
float track_names(ImDrawList* draw, const FloorScene& scene, const FloorViewState& state, const Theme& theme) {
  const Camera& camera = state.camera;
  const float line = ImGui::GetTextLineHeight(), swatch = theme.px(24), gap = theme.px(16);
  float x = camera.low.x + theme.px(12);
  const float y = camera.low.y + theme.px(8);
  float total = 0.0f;
  const bool planned = state.show_planned && scene.planned.size() > 1;
  const auto room_of = [&](const std::string& label) {
    return swatch + theme.px(6) + ImGui::CalcTextSize(label.c_str()).x + gap;
  };
  const auto fits = [&](float end) { return x + end - gap < camera.high.x - theme.px(8); };
  std::vector<const TrackLine*> named;
  for (const TrackLine& t : scene.tracks)
    if (!t.label.empty() && fits(total + room_of(t.label))) {
      named.push_back(&t);
      total += room_of(t.label);
    }
  const bool names_planned = planned && fits(total + room_of(scene.planned_name));
  if (names_planned) total += room_of(scene.planned_name);
  if (total == 0.0f) return y;
  const float below = y + line + theme.px(11), next = state.exaggerate ? below + line + theme.px(11) : below;
  if (!draw) return next;
  draw->AddRectFilled({x - theme.px(6), y - theme.px(4)}, {x + total - gap + theme.px(6), y + line + theme.px(4)},
                      faded(theme.paper, 0.85f), theme.px(4));
  const float middle = y + 0.5f * line;
  for (const TrackLine* t : named) {
    draw_stroke(*draw, {{x, middle}, {x + swatch, middle}}, t->colour, t->dash, theme);
    draw->AddText({x + swatch + theme.px(6), y}, theme.ink, t->label.c_str());
    x += room_of(t->label);
  }
  if (names_planned) {
    dashed_line(*draw, {{x, middle}, {x + swatch, middle}}, faded(theme.muted, 0.8f), theme.px(1.2f), theme.px(2),
                theme.px(4));
    draw->AddText({x + swatch + theme.px(6), y}, theme.muted, scene.planned_name.c_str());
  }
  if (state.exaggerate) {
    const std::string text = "deviation drawn " + times(state.exaggeration);
    const float w = ImGui::CalcTextSize(text.c_str()).x;
    const ImVec2 at{camera.low.x + theme.px(12), below - theme.px(1)};
    draw->AddRectFilled({at.x - theme.px(6), at.y - theme.px(3)}, {at.x + w + theme.px(6), at.y + line + theme.px(3)},
                        theme.orange, theme.px(4));
    draw->AddText(at, theme.dark ? theme.on_ink : theme.paper, text.c_str());
  }
  return next;
}

// The scale of the mismatch, below the tracks' names; in a narrow pane in several lines.
// Returns where it ends.
float mismatch_scale(ImDrawList* draw, const FloorViewState& state, float y, const Theme& theme) {
  const float line = ImGui::GetTextLineHeight(), swatch = theme.px(20), gap = theme.px(12);
  const float left = state.camera.low.x + theme.px(12), right = state.camera.high.x - theme.px(8);
  const char* title = "recorded, by its mismatch";
  const auto room_of = [&](int level) {
    return swatch + theme.px(5) + ImGui::CalcTextSize(mismatch_level_text(level)).x;
  };
  float all = ImGui::CalcTextSize(title).x;
  for (int k = 0; k < kMismatchLevels; ++k) all += gap + room_of(k);
  const bool titled = left + all < right;
  struct Place {
    float x, y;
  };
  Place places[kMismatchLevels];
  Place next{titled ? left + ImGui::CalcTextSize(title).x + gap : left, y};
  float widest = 0.0f;
  for (int k = 0; k < kMismatchLevels; ++k) {
    if (next.x > left && next.x + room_of(k) > right) next = {left, next.y + line + theme.px(2)};
    places[k] = next;
    next.x += room_of(k) + gap;
    widest = std::max(widest, next.x - gap);
  }
  const float end = next.y + line + theme.px(4);
  if (!draw) return end;
  draw->AddRectFilled({left - theme.px(6), y - theme.px(4)}, {widest + theme.px(6), next.y + line + theme.px(4)},
                      faded(theme.paper, 0.85f), theme.px(4));
  if (titled) draw->AddText({left, y}, theme.muted, title);
  for (int k = 0; k < kMismatchLevels; ++k) {
    const float x = places[k].x, middle = places[k].y + 0.5f * line;
    draw->AddLine({x, middle}, {x + swatch, middle}, mismatch_colour(k, theme), mismatch_width(k, theme) + theme.px(1));
    draw->AddText({x + swatch + theme.px(5), places[k].y}, theme.ink, mismatch_level_text(k));
  }
  return end;
}

}  // namespace

float floor_legend(ImDrawList* draw, const FloorScene& scene, const FloorViewState& state, const Theme& theme) {
  const float top = state.camera.low.y, next = track_names(draw, scene, state, theme);
  if (std::any_of(scene.trails.begin(), scene.trails.end(), [](const FloorTrail& t) { return t.by_mismatch; }))
    return mismatch_scale(draw, state, next, theme) - top;
  return next > top + theme.px(8) ? next - theme.px(7) - top : 0.0f;
}

}  // namespace odolab::ui
