#include "ui/panels/keys_panel.h"

#include "ui/look/widgets.h"

namespace odolab::ui {

void keys_panel(bool& open, const Theme& theme) {
  if (!open) return;
  struct Key {
    const char* key;
    const char* does;
  };
  static const Key kKeys[] = {
      {"Space", "play and pause"},
      {"Right, Left", "one picture forward, back (20 ms)"},
      {"Home, End", "to the start, to the latest"},
      {"Page Down, Page Up", "the next page of a guide or step of a lesson, back"},
      {"R", "restart"},
      {"+, −, 0", "faster, slower, real time"},
      {"F", "fit the floor into sight"},
      {"Delete", "take the selected cable or patch away"},
      {"Arrows, W A S D", "drive, while driving by hand"},
      {"Q, E", "the same, to the left and to the right"},
      {"Ctrl+Z, Ctrl+Y", "undo, redo"},
      {"Ctrl+O, Ctrl+S", "open, save the recording as CSV"},
      {"Ctrl+Shift+S", "save the curves over time as CSV, as far as shown"},
      {"1, 2, 3, 4, 5", "Drive, Calibrate, Compare, Diagnose, Learn"},
      {"Shift+drag", "in Diagnose: choose a stretch on the floor"},
      {"H", "hide and show the interface"},
      {"F12", "save a picture"},
      {"F1", "this list"},
      {"Ctrl+Q", "quit"},
  };
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(22), theme.px(18)));
  ImGui::Begin("Keys", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoMove);
  {
    WithFont strong(theme.strong);
    ImGui::TextUnformatted("Keys");
  }
  ImGui::Dummy({1, theme.px(2)});
  for (const Key& k : kKeys) {
    WithFont strong(theme.strong);
    ImGui::TextUnformatted(k.key);
    WithFont plain(theme.text);
    ImGui::SameLine(theme.px(190));
    ImGui::TextUnformatted(k.does);
  }
  ImGui::Dummy({1, theme.px(2)});
  note("Drop a scenario or a recording on the window to open it. In plots: wheel and drag zoom, double click fits.",
       theme);
  if (text_button("Close", theme, {true, false, true, "", ""})) open = false;
  if (ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) open = false;
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace odolab::ui
