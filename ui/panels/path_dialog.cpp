#include "ui/panels/path_dialog.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

int put_cursor(ImGuiInputTextCallbackData* data) {
  PathDialog& state = *static_cast<PathDialog*>(data->UserData);
  if (!state.to_end) return 0;
  state.to_end = false;
  data->ClearSelection();
  data->CursorPos = data->BufTextLen;
  return 0;
}

void type(PathDialog& state, const std::string& path) {
  std::snprintf(state.path, sizeof state.path, "%s", path.c_str());
  state.problem.clear();
}

// True where a file was clicked; a folder is typed into the field, and what lies in it comes next.
bool entry_list(const std::vector<PathEntry>& entries, PathDialog& state, bool& focus_field, const Theme& theme) {
  if (entries.empty()) return false;
  constexpr float kMostRows = 8.0f;
  bool chosen = false;
  const float row = ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("entries", {0.0f, std::min(kMostRows, float(entries.size())) * row + theme.px(10)}, true);
  for (const PathEntry& e : entries) {
    ImGui::PushStyleColor(ImGuiCol_Text, e.is_folder ? theme.muted : theme.ink);
    const bool clicked = ImGui::Selectable(fitted(e.name, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopStyleColor();
    if (!clicked) continue;
    type(state, e.path);
    chosen = !e.is_folder;
    focus_field = state.to_end = e.is_folder;
  }
  ImGui::EndChild();
  return chosen;
}

}  // namespace

std::string path_dialog(const char* title, const char* button, bool& open, PathDialog& state,
                        const std::vector<PathEntry>& entries, const std::vector<std::string>& proposals,
                        const Theme& theme) {
  std::string chosen;
  if (!open && !state.was_open) return chosen;
  bool focus_field = false;
  if (!state.was_open) {
    ImGui::OpenPopup(title);
    focus_field = true;
  }
  state.was_open = true;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * screen.x, 0.18f * screen.y}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSize({std::min(theme.px(620), screen.x - theme.px(40)), 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(18), theme.px(16)));
  ImGui::PushStyleColor(ImGuiCol_ModalWindowDimBg, faded(theme.ink, 0.25f));
  const bool visible = ImGui::BeginPopupModal(title, nullptr,
                                              ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                                  ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove);
  if (visible) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(8), theme.px(6)));
    {
      WithFont strong(theme.strong);
      ImGui::TextUnformatted(title);
    }
    if (focus_field) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1.0f);
    bool confirmed = ImGui::InputTextWithHint(
        "##path", "path of the file", state.path, sizeof state.path,
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_CallbackAlways,
        put_cursor, &state);
    if (ImGui::IsItemEdited()) state.problem.clear();
    if (!state.problem.empty()) warning(state.problem, theme);
    bool focus_again = false;
    if (entry_list(entries, state, focus_again, theme)) confirmed = true;
    for (const std::string& p : proposals)
      if (ImGui::Selectable(fitted(p, ImGui::GetContentRegionAvail().x).c_str())) {
        type(state, p);
        confirmed = true;
      }
    ImGui::Dummy({1, theme.px(2)});
    ButtonLook look;
    look.enabled = state.path[0] != '\0';
    look.primary = look.enabled;
    look.why_disabled = "Type a path first.";
    if (text_button(button, theme, look)) confirmed = true;
    ImGui::SameLine();
    if (text_button("Cancel", theme, {})) open = false;
    const int escape = ImGui::GetKeyIndex(ImGuiKey_Escape);
    if (escape >= 0 && ImGui::IsKeyPressed(escape)) open = false;
    if (open && confirmed && state.path[0] != '\0') {
      chosen = state.path;
      state.problem.clear();
      open = false;
    }
    if (focus_again) {
      ImGui::CloseCurrentPopup();  // and opens again with the cursor behind the folder
      state.was_open = false;
    }
    if (!open) ImGui::CloseCurrentPopup();
    ImGui::PopStyleVar();
    ImGui::EndPopup();
  }
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  if (!open || !visible) {
    state.was_open = false;
    if (!visible) open = false;
    if (!open && chosen.empty()) state.problem.clear();
  }
  return chosen;
}

}  // namespace odolab::ui
