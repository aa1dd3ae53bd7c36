// Tables of words and numbers in which no number is cut: a column is as wide as what stands in it.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

namespace odolab::ui {

// Of columns that share `room` by weight: none is narrower than it needs. Where there is not room for all of that, the
// first, which holds words, gives way.
std::vector<float> column_widths(float room, const std::vector<float>& weights, const std::vector<float>& needs);

// As ImGui's tables. What the columns need is what they needed in the picture before.
bool begin_figures(const char* id, const std::vector<float>& weights, ImGuiTableFlags flags = 0);
void end_figures();

// What stands in the current column of an open table is so wide; nothing where none is open.
void needs_width(float width);

// Words at the left of a column, wrapped where the numbers leave no room; `before` px of the column are taken already.
void figure_label(const std::string& text, ImU32 colour, float before = 0.0f);

}  // namespace odolab::ui
