// Where the panes of the window are, and how they and the edges between them are drawn.
#pragma once

#include <imgui.h>

#include "app/gui/screen.h"
#include "ui/look/theme.h"

namespace odolab {

// Where the panes are, in pixels.
struct Layout {
  ImVec2 top_size, left_low, left_size, centre_low, centre_size, right_low, right_size, bottom_low, bottom_size;
  bool has_bottom = true;
};
Layout lay_out(const ScreenState& state, ImVec2 screen, bool has_bottom, bool on_page, const ui::Theme& theme);

// How wide a pane must be for the widest row of numbers of its panels, at scale 1.
constexpr float kLeftNeeds = 288.0f, kRightNeeds = 274.0f;

// Opens a pane, `above` the others where it lies over one; end with ImGui::End(). One that is narrower than it needs is
// scrolled sideways.
void begin_pane(const char* name, ImVec2 low, ImVec2 size, bool padded, bool scrolls, ImU32 background,
                bool above = false, float needs = 0.0f);

// An edge between panes that is dragged; `value` is at scale 1 and grows with `grows_with` times the mouse's way.
void splitter(const char* id, ImVec2 low, ImVec2 size, bool vertical, double& value, double grows_with, double least,
              double most, const ui::Theme& theme);

}  // namespace odolab
