#include "ui/panels/path_dialog.h"

#include <cstdio>

#include "ui/look/widgets.h"

namespace odolab::ui {

std::string path_dialog(const char* title, const char* button, bool& open, PathDialog& state,
                        const std::vector<std::string>& proposals, const Theme& theme) {
  std::string chosen;
  if (!open) {
    state.was_open = false;
    return chosen;
  }
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * screen.x, 0.3f * screen.y}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSize({std::min(theme.px(620), screen.x - theme.px(40)), 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(18), theme.px(16)));
  ImGui::Begin(title, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoMove);
  {
    WithFont strong(theme.strong);
    ImGui::TextUnformatted(title);
  }
  if (!state.was_open) ImGui::SetKeyboardFocusHere();
  state.was_open = true;
  ImGui::SetNextItemWidth(-1.0f);
  bool confirmed = ImGui::InputTextWithHint("##path", "path of the file", state.path, sizeof state.path,
                                            ImGuiInputTextFlags_EnterReturnsTrue);
  for (const std::string& p : proposals)
    if (ImGui::Selectable(fitted(p, ImGui::GetContentRegionAvail().x).c_str())) {
      std::snprintf(state.path, sizeof state.path, "%s", p.c_str());
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
  if (confirmed && state.path[0] != '\0') {
    chosen = state.path;
    open = false;
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
  if (!open) state.was_open = false;
  return chosen;
}

}  // namespace odolab::ui
