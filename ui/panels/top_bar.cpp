#include "ui/panels/top_bar.h"

#include <cmath>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

void file_menu(const TopBar& bar, WindowChoices& choices, Actions& actions) {
  if (ImGui::MenuItem("Open…", "Ctrl+O")) choices.show_open = true;
  if (ImGui::BeginMenu("Recent", !bar.recent_files.empty())) {
    for (const std::string& path : bar.recent_files)
      if (ImGui::MenuItem(path.c_str())) actions.push_back(OpenFile{path});
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("Examples")) {
    if (ImGui::MenuItem("LabMate on its square, a cable across the way")) actions.push_back(LoadFirstScenario{});
    for (const std::string& path : bar.example_files)
      if (ImGui::MenuItem(words_of_file(path).c_str())) actions.push_back(OpenFile{path});
    ImGui::EndMenu();
  }
  ImGui::Separator();
  if (ImGui::MenuItem("Save scenario…")) choices.show_save_scenario = true;
  if (ImGui::MenuItem("Save recording as CSV…", "Ctrl+S")) choices.show_save_recording = true;
  if (ImGui::MenuItem("Save curves as CSV…", "Ctrl+Shift+S", false, bar.has_curves)) choices.show_save_curves = true;
  if (ImGui::MenuItem("Save picture", "F12")) actions.push_back(SavePicture{});
  ImGui::Separator();
  if (ImGui::MenuItem("Quit", "Ctrl+Q")) actions.push_back(Quit{});
}

void simulation_menu(const TopBar& bar, Actions& actions) {
  if (ImGui::MenuItem(bar.playing ? "Pause" : "Play", "Space")) {
    if (bar.playing)
      actions.push_back(Pause{});
    else
      actions.push_back(Play{});
  }
  if (ImGui::MenuItem("Step forward", "Right")) actions.push_back(StepForward{});
  if (ImGui::MenuItem("Step back", "Left")) actions.push_back(StepBack{});
  if (ImGui::MenuItem("To the start", "Home")) actions.push_back(ToStart{});
  if (ImGui::MenuItem("To the latest", "End")) actions.push_back(ToEnd{});
  if (ImGui::MenuItem("Restart", "R")) actions.push_back(Restart{});
  ImGui::Separator();
  if (ImGui::MenuItem("Real time", "0")) actions.push_back(SetSpeed{1.0});
  if (ImGui::MenuItem("Ten times real time")) actions.push_back(SetSpeed{10.0});
  if (ImGui::MenuItem("As fast as possible")) actions.push_back(SetSpeed{0.0});
}

void view_menu(WindowChoices& choices) {
  if (ImGui::MenuItem("Fit the floor", "F")) choices.fit_view = true;
  if (ImGui::MenuItem("Hide the interface", "H", choices.hide_interface))
    choices.hide_interface = !choices.hide_interface;
  ImGui::Separator();
  if (ImGui::MenuItem("Light", nullptr, !choices.dark)) choices.dark = false;
  if (ImGui::MenuItem("Dark", nullptr, choices.dark)) choices.dark = true;
  ImGui::Separator();
  if (ImGui::MenuItem("Size as the monitor says", nullptr, choices.scale == 0.0)) choices.scale = 0.0;
  for (const double scale : {0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0}) {
    const std::string label = "Size " + std::to_string(int(std::lround(scale * 100))) + " %";
    if (ImGui::MenuItem(label.c_str(), nullptr, choices.scale == scale)) choices.scale = scale;
  }
}

// The same choice for a window too narrow to show them beside each other.
void modes_to_unfold(const std::vector<std::string>& modes, Mode now, ImVec2 at, const Theme& theme, Actions& actions) {
  ImGui::SetCursorPos(at);
  ImGui::SetNextItemWidth(theme.px(110));
  if (!ImGui::BeginCombo("##modes", modes[static_cast<std::size_t>(now)].c_str())) return;
  for (std::size_t i = 0; i < modes.size(); ++i)
    if (ImGui::Selectable(modes[i].c_str(), i == static_cast<std::size_t>(now)))
      actions.push_back(SetMode{static_cast<Mode>(i)});
  close_on_escape();
  ImGui::EndCombo();
}

}  // namespace

Actions top_bar(const TopBar& bar, WindowChoices& choices, const Theme& theme) {
  Actions actions;
  const ImVec2 size = ImGui::GetWindowSize();
  const float y = std::round(0.5f * (size.y - ImGui::GetFrameHeight()));
  ImGui::SetCursorPos({theme.px(12), y});
  ImGui::AlignTextToFramePadding();
  {
    WithFont strong(theme.strong);
    ImGui::TextUnformatted("OdoLab");
  }
  ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(0, 0, 0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0.0f);
  struct Menu {
    const char* name;
    const char* popup;
  };
  static const Menu kMenus[] = {
      {"File", "file"}, {"Edit", "edit"}, {"Simulation", "simulation"}, {"View", "view"}, {"Help", "help"}};
  float x = theme.px(84);
  // A press beside an open menu closes it and is seen by nothing else: on another menu's name it opens that one.
  const char* open = "";
  for (const Menu& menu : kMenus)
    if (ImGui::IsPopupOpen(menu.popup)) open = menu.popup;
  if (ImGui::IsMouseClicked(0)) choices.menu_at_press = open;
  for (const Menu& menu : kMenus) {
    ImGui::SetCursorPos({x, y});
    bool wanted = ImGui::Button(menu.name);
    if (ImGui::IsMouseReleased(0) && !choices.menu_at_press.empty() && choices.menu_at_press != menu.popup) {
      const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax(),
                   at = ImGui::GetIO().MouseClickedPos[0];
      wanted = wanted || (at.x >= low.x && at.x < high.x && at.y >= low.y && at.y < high.y && ImGui::IsItemHovered());
    }
    if (wanted) ImGui::OpenPopup(menu.popup);
    const ImVec2 below{ImGui::GetItemRectMin().x, ImGui::GetItemRectMax().y + theme.px(2)};
    x += ImGui::GetItemRectSize().x;
    ImGui::SetNextWindowPos(below);
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1.0f);
    if (ImGui::BeginPopup(menu.popup)) {
      switch (menu.name[0]) {
        case 'F':
          file_menu(bar, choices, actions);
          break;
        case 'E':
          if (ImGui::MenuItem("Undo", "Ctrl+Z", false, bar.can_undo)) actions.push_back(Undo{});
          if (ImGui::MenuItem("Redo", "Ctrl+Y", false, bar.can_redo)) actions.push_back(Redo{});
          break;
        case 'S':
          simulation_menu(bar, actions);
          break;
        case 'V':
          view_menu(choices);
          break;
        default:
          if (ImGui::MenuItem("Keys", "F1")) choices.show_keys = true;
      }
      close_on_escape();
      ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
  }
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();

  const std::vector<std::string> modes{"Drive", "Calibrate", "Compare", "Diagnose", "Learn"};
  float width = 0.0f;
  for (const std::string& m : modes) width += ImGui::CalcTextSize(m.c_str()).x + 2.0f * theme.px(12);
  const float modes_x = size.x - width - theme.px(12);
  const float room = modes_x - x - theme.px(32);
  // A few letters of it would say nothing.
  const bool has_room = room > theme.px(100) || room > ImGui::CalcTextSize(bar.title.c_str()).x;
  const std::string title = has_room ? fitted(bar.title, room) : "";
  ImGui::SetCursorPos({std::round(x + theme.px(16) + 0.5f * (room - ImGui::CalcTextSize(title.c_str()).x)), y});
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", title.c_str());
  if (room < 0.0f) {
    modes_to_unfold(modes, bar.mode, {x + theme.px(12), y}, theme, actions);
    return actions;
  }
  ImGui::SetCursorPos({modes_x, y});
  if (const auto choice = segmented("modes", modes, int(bar.mode), theme)) actions.push_back(SetMode{Mode(*choice)});
  return actions;
}

}  // namespace odolab::ui
