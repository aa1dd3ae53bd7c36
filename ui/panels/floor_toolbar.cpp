#include "ui/panels/floor_toolbar.h"

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

constexpr float kFactorWidth = 52;  // at scale 1

void brush_buttons(FloorViewState& state, const Theme& theme) {
  ButtonLook pointer, brush;
  pointer.toggled = state.tool != FloorTool::brush;
  pointer.tip = "Move the view: drag the floor to pan; the wheel zooms.";
  if (icon_button("pointer", Icon::pointer, theme, pointer)) state.tool = FloorTool::pointer;
  ImGui::SameLine(0, theme.px(2));
  brush.toggled = state.tool == FloorTool::brush;
  brush.tip = "Choose a stretch: drag a rectangle over it (or hold Shift). It is lit in the plot below.";
  if (icon_button("brush", Icon::brush, theme, brush)) state.tool = FloorTool::brush;
}

void tool_buttons(FloorViewState& state, bool editable, const Theme& theme) {
  struct Tool {
    FloorTool tool;
    Icon icon;
    const char* id;
    const char* tip;
  };
  static const Tool kTools[] = {
      {FloorTool::pointer, Icon::pointer, "pointer",
       "Move things and the view. Drag a thing to move it, the floor to pan; the wheel zooms."},
      {FloorTool::bump, Icon::cable, "cable",
       "Put a cable on the floor: click where it shall lie. A wheel that climbs it turns further than it travels."},
      {FloorTool::slip_disc, Icon::disc, "disc", "Put down a round slippery patch: click where."},
      {FloorTool::slip_rectangle, Icon::rectangle, "rectangle", "Put down a rectangular slippery patch: click where."},
  };
  for (const Tool& tool : kTools) {
    ButtonLook look;
    look.enabled = editable;
    look.toggled = editable && state.tool == tool.tool;
    look.tip = tool.tip;
    look.why_disabled = "This floor is not edited here: change it in Drive.";
    if (icon_button(tool.id, tool.icon, theme, look)) state.tool = tool.tool;
    ImGui::SameLine(0, theme.px(2));
  }
}

void exaggeration_choice(FloorViewState& state, const FloorScene& scene, const Theme& theme) {
  ButtonLook exaggerate;
  exaggerate.toggled = state.exaggerate;
  exaggerate.tip = "Draw the deviation of the " + scene.deviating_name + " track from the " + scene.reference_name +
                   " one larger than it is, by the factor beside this button";
  if (icon_button("exaggerate", Icon::exaggerate, theme, exaggerate)) state.exaggerate = !state.exaggerate;
  ImGui::SameLine(0, theme.px(6));
  NumberField factor{"##factor", {"×", 1.0, 0, 0.2}, 2.0, 200.0, "How many times larger the deviation is drawn."};
  if (number_field(factor, state.exaggeration, theme.px(kFactorWidth), theme) != Edited::no) state.exaggerate = true;
}

// Where the toolbar has no room for it, how large the deviation is drawn is chosen here, too.
void layer_menu(FloorViewState& state, const FloorScene& scene, bool with_exaggeration, const Theme& theme) {
  ButtonLook look;
  look.tip = "What is drawn";
  if (icon_button("layers", Icon::layers, theme, look)) ImGui::OpenPopup("layers");
  if (ImGui::BeginPopup("layers")) {
    ImGui::Checkbox("Grid and rulers", &state.show_grid);
    ImGui::Checkbox("Planned path", &state.show_planned);
    ImGui::Checkbox("Tracks", &state.show_tracks);
    ImGui::Checkbox("Cables and patches", &state.show_things);
    ImGui::Checkbox("Lens", &state.show_lens);
    if (with_exaggeration) {
      ImGui::Separator();
      exaggeration_choice(state, scene, theme);
    }
    close_on_escape();
    ImGui::EndPopup();
  }
}

}  // namespace

void floor_toolbar(FloorViewState& state, const FloorScene& scene, const Theme& theme) {
  ImGui::SetCursorPos({theme.px(8), theme.px(5)});
  if (scene.brushable)
    brush_buttons(state, theme);
  else
    tool_buttons(state, scene.editable, theme);
  ImGui::SameLine(0, theme.px(14));
  ButtonLook fit;
  fit.tip = "Fit everything into sight (F)";
  if (icon_button("fit", Icon::fit, theme, fit)) state.fit_next = true;
  ImGui::SameLine(0, theme.px(2));
  ButtonLook follow;
  follow.toggled = state.follow;
  follow.tip = "Follow the vehicle";
  if (icon_button("follow", Icon::follow, theme, follow)) state.follow = !state.follow;
  ImGui::SameLine(0, theme.px(2));
  ButtonLook lens;
  lens.toggled = state.show_lens;
  lens.tip = "A lens over the vehicle shows the gap between the poses at a stated magnification";
  if (icon_button("lens", Icon::lens, theme, lens)) state.show_lens = !state.show_lens;
  ImGui::SameLine(0, theme.px(2));
  const float room = ImGui::GetWindowSize().x - ImGui::GetCursorPosX();
  const bool beside = room > ImGui::GetFrameHeight() * 2.0f + theme.px(14 + 6 + kFactorWidth + 8);
  layer_menu(state, scene, !beside, theme);
  if (!beside) return;
  ImGui::SameLine(0, theme.px(14));
  exaggeration_choice(state, scene, theme);
}

}  // namespace odolab::ui
