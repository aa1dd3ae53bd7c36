// Lines longer than ImGui draws well, and dashed ones, which it lacks.
#pragma once

#include <imgui.h>

#include <vector>

namespace odolab::ui {

// Any number of points, in pieces that ImGui draws without fault.
void solid_line(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 colour, float width);

// Dashes run on across the corners. Parts outside the draw list's clip rectangle cost nothing.
void dashed_line(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 colour, float width, float dash, float gap);

}  // namespace odolab::ui
