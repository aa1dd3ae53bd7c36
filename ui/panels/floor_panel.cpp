#include "ui/panels/floor_panel.h"

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

// One line of the list: swatch, name, and a cross that takes the thing away.
bool thing_line(const char* name, const std::string& figure, bool selected, bool is_bump, bool& remove,
                const Theme& theme) {
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("##line", {width - height * 1.3f, height});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (selected || ImGui::IsItemHovered())
    draw.AddRectFilled(at, {at.x + width - height * 1.3f, at.y + height}, selected ? theme.pressed : theme.hovered,
                       theme.px(4));
  const float y = at.y + 0.5f * (height - ImGui::GetTextLineHeight()), s = theme.px(14), mid = at.y + 0.5f * height;
  if (is_bump) {
    draw.AddLine({at.x + theme.px(6), mid}, {at.x + theme.px(6) + s, mid}, theme.bump_edge, theme.px(7));
    draw.AddLine({at.x + theme.px(7), mid}, {at.x + theme.px(5) + s, mid}, theme.bump, theme.px(4.5f));
  } else {
    draw_icon(draw, Icon::disc, {at.x + theme.px(6) + 0.5f * s, mid}, s, theme.zone);
  }
  draw.AddText({at.x + theme.px(28), y}, theme.ink, name);
  const float w = ImGui::CalcTextSize(figure.c_str()).x;
  draw.AddText({at.x + width - height * 1.3f - w - theme.px(6), y}, theme.muted, figure.c_str());
  ImGui::SameLine(0, 0);
  ButtonLook look;
  look.tip = "Take it away (Delete)";
  remove = icon_button("remove", Icon::close, theme, look);
  return clicked;
}

Edited bump_fields(Bump& bump, const Theme& theme) {
  Edited result = number_row("Height",
                             {"##height",
                              {"mm", 1e3, 1, 0.05},
                              0.0,
                              0.05,
                              "Height of the cable. 10 mm under one wheel turns the LabMate by 0.59°."},
                             bump.height_m, theme);
  result = more(result,
                number_row("Length", {"##length", kMetres, 0.02, 100.0, "Length of the cable."}, bump.length_m, theme));
  result = more(
      result,
      number_row("Direction",
                 {"##direction", {"°", 180.0 / kPi, 0, 0.5}, 0.0, 0.0, "Along the cable, counter-clockwise from x."},
                 bump.direction_rad, theme));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Under");
  ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.5f + ImGui::GetCursorPosX());
  ImGui::SetNextItemWidth(-1.0f);
  int under = int(bump.under);
  if (ImGui::Combo("##under", &under, "any wheel\0left wheel\0right wheel\0inside wheel\0")) {
    bump.under = Under(under);
    result = Edited::done;
  }
  tooltip("Which wheels it acts on. The inside wheel faces the inside of the square.", theme);
  return result;
}

Edited zone_fields(SlipZone& zone, const Theme& theme) {
  Edited result =
      number_row("Slip", {"##slip", kPercent, 0.0, 1.0, "Share of the rolled distance that is lost on this patch."},
                 zone.slip, theme);
  bool own = zone.friction.has_value();
  if (ImGui::Checkbox("Its own friction", &own)) {
    zone.friction = own ? std::optional<double>(0.2) : std::nullopt;
    result = Edited::done;
  }
  if (zone.friction)
    result = more(
        result, number_row("Friction",
                           {"##friction", kCoefficient, 0.0, 2.0, "Coefficient on this patch, instead of the floor's."},
                           *zone.friction, theme));
  if (Disc* disc = std::get_if<Disc>(&zone.shape))
    result = more(result, number_row("Radius", {"##radius", kMetres, 0.05, 100.0, "Radius of the patch."},
                                     disc->radius_m, theme));
  if (Rectangle* r = std::get_if<Rectangle>(&zone.shape)) {
    result = more(result, number_row("Width", {"##width", kMetres, 0.05, 100.0, "Along x before it is turned."},
                                     r->width_m, theme));
    result = more(result, number_row("Depth", {"##depth", kMetres, 0.05, 100.0, "Along y before it is turned."},
                                     r->height_m, theme));
    result =
        more(result,
             number_row("Direction",
                        {"##turned", {"°", 180.0 / kPi, 0, 0.5}, 0.0, 0.0, "Turned by this angle, counter-clockwise."},
                        r->direction_rad, theme));
  }
  return result;
}

std::string figure_of(const SlipZone& zone) {
  if (zone.slip > 0.0) return shown(zone.slip, kPercent, 0) + " slip";
  if (zone.friction) return "µ " + shown(*zone.friction, kCoefficient);
  return "no effect";
}

const char* name_of(const Shape& shape) {
  if (std::holds_alternative<Disc>(shape)) return "Slippery disc";
  return std::holds_alternative<Rectangle>(shape) ? "Slippery patch" : "Slippery polygon";
}

}  // namespace

Actions floor_panel(const Floor& floor, std::optional<FloorThing>& selected, FloorPanelState& state, Vec2 place,
                    const Theme& theme) {
  Actions actions;
  if (!section("Floor", theme)) return actions;
  ImGui::PushID("floor");
  if (!ImGui::IsAnyItemActive()) state.in_gesture = false;
  Floor edited = floor;
  Edited result = number_row("Friction µ",
                             {"##friction", kCoefficient, 0.0, 2.0,
                              "Coefficient of friction between tyre and floor. Wheels slip where the motor asks for "
                              "more than µ times the load."},
                             edited.friction, theme);
  result = more(result, number_row("Tilt",
                                   {"##tilt", kDegrees, -0.35, 0.35,
                                    "Slope of the whole floor; an arrow in the view points downhill."},
                                   edited.tilt_rad, theme));
  if (edited.tilt_rad != 0.0)
    result = more(result, number_row("Downhill toward",
                                     {"##downhill",
                                      {"°", 180.0 / kPi, 0, 0.5},
                                      0.0,
                                      0.0,
                                      "Direction in which the floor falls, counter-clockwise from x."},
                                     edited.downhill_direction_rad, theme));
  result = more(result, number_row("Roughness",
                                   {"##roughness", kMillimetres, 0.0, 0.02,
                                    "Greatest height of the random bumps under each wheel. The report's simulation has "
                                    "1 mm about every 2 cm (section 4.6.2)."},
                                   edited.roughness.largest_height_m, theme));
  if (edited.roughness.largest_height_m > 0.0)
    result = more(
        result, number_row("… every",
                           {"##spacing", {"mm", 1e3, 0, 0.2}, 0.002, 1.0, "Distance from one random bump to the next."},
                           edited.roughness.spacing_m, theme));

  std::optional<FloorThing> remove;
  const auto list = [&](ThingKind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const FloorThing thing{kind, i};
      const bool is_bump = kind == ThingKind::bump;
      ImGui::PushID(int(i) + (is_bump ? 0 : 10000));
      bool gone = false;
      const std::string figure =
          is_bump ? shown(floor.bumps[i].height_m, kMillimetres) : figure_of(floor.slip_zones[i]);
      const bool chosen = selected == thing;
      if (thing_line(is_bump ? "Cable" : name_of(floor.slip_zones[i].shape), figure, chosen, is_bump, gone, theme))
        selected = chosen ? std::nullopt : std::optional<FloorThing>(thing);
      if (gone) remove = thing;
      if (chosen) {
        ImGui::Indent(theme.px(10));
        result = more(result, is_bump ? bump_fields(edited.bumps[i], theme) : zone_fields(edited.slip_zones[i], theme));
        ImGui::Unindent(theme.px(10));
      }
      ImGui::PopID();
    }
  };
  list(ThingKind::bump, floor.bumps.size());
  list(ThingKind::slip_zone, floor.slip_zones.size());
  if (remove) {
    edited = removed(edited, *remove);
    selected.reset();
    result = Edited::done;
  }
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  ButtonLook add;
  add.tip = "Put a cable in the middle of the view, and drag it where it shall lie.";
  if (text_button("Add a cable", theme, add, half)) {
    edited.bumps.push_back(new_bump(place));
    selected = FloorThing{ThingKind::bump, edited.bumps.size() - 1};
    result = Edited::done;
  }
  ImGui::SameLine();
  add.tip = "Put a slippery disc in the middle of the view, and drag it where it shall lie.";
  if (text_button("Add a patch", theme, add, half)) {
    edited.slip_zones.push_back(new_slip_disc(place));
    selected = FloorThing{ThingKind::slip_zone, edited.slip_zones.size() - 1};
    result = Edited::done;
  }
  ImGui::PopID();
  if (result == Edited::no || !problems_in(edited).empty()) return actions;
  actions.push_back(SetFloor{std::move(edited), !state.in_gesture});
  state.in_gesture = result == Edited::changing;
  return actions;
}

}  // namespace odolab::ui
