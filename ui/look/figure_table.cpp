#include "ui/look/figure_table.h"

#include <algorithm>
#include <cmath>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

// The one table that is being drawn.
struct Figures {
  std::string id;
  std::vector<float> needs;
};

Figures& figures() {
  static Figures open;
  return open;
}

float& kept_need(std::size_t column) {
  const std::string key = figures().id + "#" + std::to_string(column);
  return *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID(key.c_str()), 0.0f);
}

}  // namespace

std::vector<float> column_widths(float room, const std::vector<float>& weights, const std::vector<float>& needs) {
  std::vector<float> widths(needs);
  float needed = 0.0f;
  for (const float need : needs) needed += need;
  if (needed > room) {
    widths[0] = std::max(1.0f, room - (needed - needs[0]));
    return widths;
  }
  // Whoever needs more than its share takes that; the others share the rest.
  std::vector<bool> has_own(needs.size(), false);
  for (bool again = true; again;) {
    again = false;
    float rest = room, weight = 0.0f;
    for (std::size_t i = 0; i < needs.size(); ++i) {
      if (has_own[i])
        rest -= needs[i];
      else
        weight += weights[i];
    }
    for (std::size_t i = 0; i < needs.size(); ++i) {
      if (has_own[i]) continue;
      widths[i] = rest * weights[i] / weight;
      if (widths[i] < needs[i]) has_own[i] = again = true;
    }
    for (std::size_t i = 0; i < needs.size(); ++i)
      if (has_own[i]) widths[i] = needs[i];
  }
  return widths;
}

bool begin_figures(const char* id, const std::vector<float>& weights, ImGuiTableFlags flags) {
  figures() = {id, std::vector<float>(weights.size(), 0.0f)};
  std::vector<float> needs;
  for (std::size_t i = 0; i < weights.size(); ++i) needs.push_back(kept_need(i));
  const float gaps = 2.0f * ImGui::GetStyle().CellPadding.x * float(weights.size() - 1);
  const float room = ImGui::GetContentRegionAvail().x - gaps;
  if (!ImGui::BeginTable(id, int(weights.size()), flags)) {
    figures() = {};
    return false;
  }
  for (const float width : column_widths(room, weights, needs))
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, width);
  return true;
}

void end_figures() {
  ImGui::EndTable();
  for (std::size_t i = 0; i < figures().needs.size(); ++i) kept_need(i) = figures().needs[i];
  figures() = {};
}

void needs_width(float width) {
  std::vector<float>& needs = figures().needs;
  const int column = needs.empty() ? -1 : ImGui::TableGetColumnIndex();
  if (column < 0 || column >= int(needs.size())) return;
  float& need = needs[std::size_t(column)];
  need = std::max(need, std::ceil(width) + 1.0f);
}

void figure_label(const std::string& text, ImU32 colour, float before) {
  needs_width(before + ImGui::CalcTextSize(text.c_str()).x);
  words(text, colour);
}

}  // namespace odolab::ui
