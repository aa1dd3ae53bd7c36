#include "ui/panels/floor_view.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/mismatch.h"
#include "ui/floor/drawing.h"
#include "ui/floor/lens.h"
#include "ui/floor/vehicle_drawing.h"
#include "ui/look/strokes.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

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

void layer_menu(FloorViewState& state, const Theme& theme) {
  ButtonLook look;
  look.tip = "What is drawn";
  if (icon_button("layers", Icon::layers, theme, look)) ImGui::OpenPopup("layers");
  if (ImGui::BeginPopup("layers")) {
    ImGui::Checkbox("Grid and rulers", &state.show_grid);
    ImGui::Checkbox("Planned path", &state.show_planned);
    ImGui::Checkbox("Tracks", &state.show_tracks);
    ImGui::Checkbox("Cables and patches", &state.show_things);
    ImGui::Checkbox("Lens", &state.show_lens);
    ImGui::EndPopup();
  }
}

void toolbar(FloorViewState& state, const FloorScene& scene, const Theme& theme) {
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
  layer_menu(state, theme);
  ImGui::SameLine(0, theme.px(14));
  ButtonLook exaggerate;
  exaggerate.toggled = state.exaggerate;
  exaggerate.tip = "Draw the deviation of the " + scene.deviating_name + " track from the " + scene.reference_name +
                   " one larger than it is, by the factor beside this button";
  if (icon_button("exaggerate", Icon::exaggerate, theme, exaggerate)) state.exaggerate = !state.exaggerate;
  ImGui::SameLine(0, theme.px(6));
  NumberField factor{"##factor", {"×", 1.0, 0, 0.2}, 2.0, 200.0, "How many times larger the deviation is drawn."};
  if (number_field(factor, state.exaggeration, theme.px(52), theme) != Edited::no) state.exaggerate = true;
}

// 0 where there is no room for one that says anything.
float lens_side(const Camera& camera, const Theme& theme) {
  const float side =
      std::min(theme.px(200), 0.42f * std::min(camera.high.x - camera.low.x, camera.high.y - camera.low.y));
  return side < theme.px(130) ? 0.0f : side;
}

// Everything worth seeing, for a fit.
void extent_of(const FloorScene& scene, Vec2& low, Vec2& high) {
  low = {1e300, 1e300};
  high = {-1e300, -1e300};
  const auto take = [&](Vec2 p, double reach = 0.0) {
    low = {std::min(low.x_m, p.x_m - reach), std::min(low.y_m, p.y_m - reach)};
    high = {std::max(high.x_m, p.x_m + reach), std::max(high.y_m, p.y_m + reach)};
  };
  // All along its path the vehicle stays in sight, without the view growing when it comes to an edge.
  const double reach_m = scene.vehicles.empty() ? 0.3 : reach_of(scene.vehicles.front());
  for (const Vec2 p : scene.planned) take(p, reach_m);
  const auto take_trails = [&](bool aside) {
    for (const FloorTrail& t : scene.trails)
      if (t.trail && !t.trail->empty() && t.aside == aside) {
        take(t.trail->lowest(), 0.1);
        take(t.trail->highest(), 0.1);
      }
  };
  take_trails(false);
  for (const TrackLine& line : scene.tracks)
    if (line.track)
      for (const TimedPose& p : *line.track) take(p.pose.position(), 0.1);
  for (const VehicleGlyph& v : scene.vehicles) take(v.pose.position(), reach_of(v));
  if (scene.floor && low.x_m <= high.x_m)
    for (const Bump& bump : scene.floor->bumps) {
      const auto [a, b] = ends_of(bump);
      take(a);
      take(b);
    }
  if (low.x_m > high.x_m) take_trails(true);
  if (low.x_m > high.x_m) {
    low = {-1.0, -1.0};
    high = {5.0, 5.0};
  }
}

void legend(ImDrawList& draw, const FloorScene& scene, const FloorViewState& state, const Theme& theme) {
  const Camera& camera = state.camera;
  const float line = ImGui::GetTextLineHeight(), swatch = theme.px(24), gap = theme.px(16);
  float x = camera.low.x + theme.px(12);
  const float y = camera.low.y + theme.px(8);
  float total = 0.0f;
  const bool planned = state.show_planned && scene.planned.size() > 1;
  const auto room_of = [&](const std::string& label) {
    return swatch + theme.px(6) + ImGui::CalcTextSize(label.c_str()).x + gap;
  };
  const auto fits = [&](float end) { return x + end - gap < camera.high.x - theme.px(8); };
  std::vector<const TrackLine*> named;
  for (const TrackLine& t : scene.tracks)
    if (!t.label.empty() && fits(total + room_of(t.label))) {
      named.push_back(&t);
      total += room_of(t.label);
    }
  const bool names_planned = planned && fits(total + room_of(scene.planned_name));
  if (names_planned) total += room_of(scene.planned_name);
  if (total == 0.0f) return;
  draw.AddRectFilled({x - theme.px(6), y - theme.px(4)}, {x + total - gap + theme.px(6), y + line + theme.px(4)},
                     faded(theme.paper, 0.85f), theme.px(4));
  const float middle = y + 0.5f * line;
  for (const TrackLine* t : named) {
    draw_stroke(draw, {{x, middle}, {x + swatch, middle}}, t->colour, t->dash, theme);
    draw.AddText({x + swatch + theme.px(6), y}, theme.ink, t->label.c_str());
    x += room_of(t->label);
  }
  if (names_planned) {
    dashed_line(draw, {{x, middle}, {x + swatch, middle}}, faded(theme.muted, 0.8f), theme.px(1.2f), theme.px(2),
                theme.px(4));
    draw.AddText({x + swatch + theme.px(6), y}, theme.muted, scene.planned_name.c_str());
  }
  if (state.exaggerate) {
    const std::string text = "deviation drawn " + times(state.exaggeration);
    const float w = ImGui::CalcTextSize(text.c_str()).x;
    const ImVec2 at{camera.low.x + theme.px(12), y + line + theme.px(10)};
    draw.AddRectFilled({at.x - theme.px(6), at.y - theme.px(3)}, {at.x + w + theme.px(6), at.y + line + theme.px(3)},
                       theme.orange, theme.px(4));
    draw.AddText(at, theme.dark ? theme.on_ink : theme.paper, text.c_str());
  }
}

// The scale of the mismatch, under the legend's lines.
void mismatch_scale(ImDrawList& draw, const FloorViewState& state, float y, const Theme& theme) {
  const float line = ImGui::GetTextLineHeight(), swatch = theme.px(20), gap = theme.px(12);
  const char* title = "recorded, by its mismatch";
  float total = 0.0f;
  for (int k = 0; k < kMismatchLevels; ++k)
    total += swatch + theme.px(5) + ImGui::CalcTextSize(mismatch_level_text(k)).x + (k + 1 < kMismatchLevels ? gap : 0);
  float x = state.camera.low.x + theme.px(12);
  const float with_title = total + ImGui::CalcTextSize(title).x + gap;
  const bool titled = x + with_title < state.camera.high.x;
  draw.AddRectFilled({x - theme.px(6), y - theme.px(4)},
                     {x + (titled ? with_title : total) + theme.px(6), y + line + theme.px(4)},
                     faded(theme.paper, 0.85f), theme.px(4));
  if (titled) {
    draw.AddText({x, y}, theme.muted, title);
    x += ImGui::CalcTextSize(title).x + gap;
  }
  for (int k = 0; k < kMismatchLevels; ++k) {
    const float middle = y + 0.5f * line;
    draw.AddLine({x, middle}, {x + swatch, middle}, mismatch_colour(k, theme), mismatch_width(k, theme) + theme.px(1));
    x += swatch + theme.px(5);
    draw.AddText({x, y}, theme.ink, mismatch_level_text(k));
    x += ImGui::CalcTextSize(mismatch_level_text(k)).x + gap;
  }
}

void draw_disc(ImDrawList& draw, const Camera& camera, const FloorDisc& disc, const Theme& theme) {
  const ImVec2 at = camera.screen(disc.centre);
  const float radius = std::max(theme.px(8), float(disc.radius_m * camera.px_per_m));
  std::vector<ImVec2> rim;
  for (int i = 0; i <= 64; ++i) {
    const float a = float(i) / 64.0f * 6.2831853f;
    rim.push_back({at.x + radius * std::cos(a), at.y + radius * std::sin(a)});
  }
  dashed_line(draw, rim, theme.blue, theme.px(2), theme.px(6), theme.px(4));
  const ImVec2 size = ImGui::CalcTextSize(disc.label.c_str());
  const ImVec2 text{std::round(at.x - 0.5f * size.x), std::round(at.y - radius - size.y - theme.px(5))};
  draw.AddRectFilled({text.x - theme.px(4), text.y - theme.px(1)}, {text.x + size.x + theme.px(4), text.y + size.y},
                     faded(theme.paper, 0.85f), theme.px(3));
  draw.AddText(text, theme.blue, disc.label.c_str());
}

void draw_trails(ImDrawList& draw, const FloorScene& scene, const Camera& camera, const Theme& theme) {
  for (const FloorTrail& t : scene.trails) {
    if (!t.trail) continue;
    if (t.by_mismatch)
      draw_mismatch(draw, camera, *t.trail, t.lit, theme);
    else
      draw_trail(draw, camera, *t.trail, t.colour, theme.px(1.4f), theme);
  }
}

void draw_scene(ImDrawList& draw, const FloorScene& scene, const FloorViewState& state, const Theme& theme) {
  const Camera& camera = state.camera;
  const double factor = state.exaggerate ? state.exaggeration : 1.0;
  if (state.show_grid)
    draw_grid(draw, camera, theme);
  else
    draw.AddRectFilled(camera.low, camera.high, theme.paper);
  if (scene.floor && state.show_things) {
    for (std::size_t i = 0; i < scene.floor->slip_zones.size(); ++i)
      draw_slip_zone(draw, camera, scene.floor->slip_zones[i], state.selected == FloorThing{ThingKind::slip_zone, i},
                     theme);
    for (std::size_t i = 0; i < scene.floor->bumps.size(); ++i)
      draw_bump(draw, camera, scene.floor->bumps[i], state.selected == FloorThing{ThingKind::bump, i}, theme);
  }
  if (state.show_planned) draw_planned(draw, camera, scene.planned, theme);
  if (state.show_tracks) draw_trails(draw, scene, camera, theme);
  if (state.show_tracks)
    for (const TrackLine& line : scene.tracks) {
      TrackLine drawn = line;
      if (line.reference && line.end && scene.reference) drawn.end = exaggerated(*scene.reference, *line.end, factor);
      draw_track(draw, camera, drawn, factor, theme);
    }
  if (state.show_things)
    for (const FloorDisc& disc : scene.discs) draw_disc(draw, camera, disc, theme);
  for (const VehicleGlyph& vehicle : scene.vehicles) {
    VehicleGlyph drawn = vehicle;
    if (vehicle.outline && scene.reference) drawn.pose = exaggerated(*scene.reference, vehicle.pose, factor);
    draw_vehicle(draw, camera, drawn, theme);
  }
  if (scene.reference && scene.deviating) {
    const Pose end = exaggerated(*scene.reference, *scene.deviating, factor);
    draw.AddLine(camera.screen(scene.reference->position()), camera.screen(end.position()), theme.orange, theme.px(2));
  }
  if (state.show_grid) draw_origin(draw, camera, theme);
  if (scene.floor) draw_tilt(draw, camera, *scene.floor, theme);
  if (scene.tracks.empty() && scene.trails.empty() && scene.vehicles.empty() && !scene.empty_text.empty()) {
    const ImVec2 size = ImGui::CalcTextSize(scene.empty_text.c_str());
    const ImVec2 at{std::round(0.5f * (camera.low.x + camera.high.x - size.x)),
                    std::round(0.5f * (camera.low.y + camera.high.y - size.y))};
    draw.AddRectFilled({at.x - theme.px(10), at.y - theme.px(6)},
                       {at.x + size.x + theme.px(10), at.y + size.y + theme.px(6)}, theme.paper, theme.px(4));
    draw.AddText(at, theme.muted, scene.empty_text.c_str());
  }
  legend(draw, scene, state, theme);
  if (std::any_of(scene.trails.begin(), scene.trails.end(), [](const FloorTrail& t) { return t.by_mismatch; }))
    mismatch_scale(
        draw, state,
        camera.low.y + theme.px(8) + (state.exaggerate ? 2.0f : 1.0f) * (ImGui::GetTextLineHeight() + theme.px(11)),
        theme);
  if (state.brushing)
    draw.AddRectFilled(camera.screen(state.brush_from), ImGui::GetIO().MousePos, faded(theme.sky, 0.25f));
  draw_scale_bar(draw, camera, theme);
  if (const float side = lens_side(camera, theme); state.show_lens && side > 0.0f) {
    const float margin = theme.px(14), below = margin + 2.0f * ImGui::GetTextLineHeight() + theme.px(16);
    draw_lens(draw, {camera.high.x - margin - side, camera.high.y - below - side},
              {camera.high.x - margin, camera.high.y - below}, scene, camera.px_per_m, theme);
  }
}

Actions put_down(const FloorScene& scene, FloorViewState& state, FloorTool tool, Vec2 at) {
  Floor floor = *scene.floor;
  if (tool == FloorTool::bump) {
    floor.bumps.push_back(new_bump(at));
    state.selected = FloorThing{ThingKind::bump, floor.bumps.size() - 1};
  } else {
    floor.slip_zones.push_back(tool == FloorTool::slip_disc ? new_slip_disc(at) : new_slip_rectangle(at));
    state.selected = FloorThing{ThingKind::slip_zone, floor.slip_zones.size() - 1};
  }
  state.tool = FloorTool::pointer;
  return {SetFloor{std::move(floor), true}};
}

Actions context_menu(const FloorScene& scene, FloorViewState& state) {
  Actions actions;
  if (!ImGui::BeginPopup("floor menu")) return actions;
  if (scene.editable && scene.floor) {
    if (state.selected && exists(*scene.floor, *state.selected) && ImGui::MenuItem("Remove this", "Delete")) {
      actions.push_back(SetFloor{removed(*scene.floor, *state.selected), true});
      state.selected.reset();
    }
    if (ImGui::MenuItem("Put a cable here")) append(actions, put_down(scene, state, FloorTool::bump, state.menu_at));
    if (ImGui::MenuItem("Put a slippery disc here"))
      append(actions, put_down(scene, state, FloorTool::slip_disc, state.menu_at));
    if (ImGui::MenuItem("Put a slippery rectangle here"))
      append(actions, put_down(scene, state, FloorTool::slip_rectangle, state.menu_at));
    ImGui::Separator();
    if (!scene.vehicles.empty() && ImGui::MenuItem("Push the vehicle toward here")) {
      const Vec2 way = state.menu_at - scene.vehicles.front().pose.position();
      if (length(way) > 0.0) actions.push_back(Push{(scene.push_ns / length(way)) * way});
    }
  }
  if (ImGui::MenuItem("Fit everything", "F")) state.fit_next = true;
  if (ImGui::MenuItem("Follow the vehicle", nullptr, state.follow)) state.follow = !state.follow;
  ImGui::EndPopup();
  return actions;
}

Actions react(const FloorScene& scene, FloorViewState& state, const Theme& theme) {
  Actions actions;
  Camera& camera = state.camera;
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 mouse = io.MousePos;
  const bool hovered = ImGui::IsItemHovered();
  const bool editable = scene.editable && scene.floor && state.show_things;
  const float reach = theme.px(9);

  if (hovered && io.MouseWheel != 0.0f) {
    camera.zoom(mouse, std::pow(1.18, double(io.MouseWheel)));
    state.touched = true;
  }
  if (hovered && ImGui::IsMouseClicked(1)) {
    if (editable)
      if (const auto grasp = grasp_at(*scene.floor, camera, mouse, reach, state.selected))
        state.selected = grasp->thing;
    state.menu_at = camera.floor(mouse);
    ImGui::OpenPopup("floor menu");
  }
  if (ImGui::IsItemActivated()) {
    state.grasp.reset();
    state.panning = false;
    if (scene.brushable && (state.tool == FloorTool::brush || io.KeyShift)) {
      state.brushing = true;
      state.brush_from = camera.floor(mouse);
    } else if (editable && state.tool != FloorTool::pointer) {
      append(actions, put_down(scene, state, state.tool, camera.floor(mouse)));
    } else {
      if (editable) state.grasp = grasp_at(*scene.floor, camera, mouse, reach, state.selected);
      state.panning = !state.grasp;
      state.selected = state.grasp ? std::optional<FloorThing>(state.grasp->thing) : std::nullopt;
      state.grasp_from = camera.floor(mouse);
      state.gesture_began = true;
    }
  } else if (ImGui::IsItemActive()) {
    const Vec2 at = camera.floor(mouse);
    if (state.grasp && editable && length(at - state.grasp_from) > 0.0) {
      actions.push_back(SetFloor{dragged(*scene.floor, *state.grasp, state.grasp_from, at), state.gesture_began});
      state.gesture_began = false;
      state.grasp_from = at;
    } else if (state.panning && length(at - state.grasp_from) > 0.0) {
      camera.centre = camera.centre - (at - state.grasp_from);
      state.touched = true;
      state.follow = false;
    }
  } else {
    if (state.brushing) state.brushed = {state.brush_from, camera.floor(mouse)};
    state.brushing = false;
    state.grasp.reset();
    state.panning = false;
  }
  if (hovered && state.tool == FloorTool::pointer && ImGui::IsMouseDoubleClicked(0) && !state.grasp)
    state.fit_next = true;
  if (hovered && editable && state.tool == FloorTool::pointer && !state.panning) {
    if (const auto grasp = grasp_at(*scene.floor, camera, mouse, reach, state.selected))
      ImGui::SetMouseCursor(grasp->grip == Grip::body ? ImGuiMouseCursor_Hand : ImGuiMouseCursor_ResizeAll);
  }
  return actions;
}

}  // namespace

Actions floor_view(const FloorScene& scene, FloorViewState& state, const Theme& theme) {
  const float bar = ImGui::GetFrameHeight() + theme.px(10);
  const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  toolbar(state, scene, theme);
  Camera& camera = state.camera;
  camera.low = {low.x, low.y + bar};
  camera.high = {low.x + size.x, low.y + size.y};
  if (camera.high.x - camera.low.x < 20.0f || camera.high.y - camera.low.y < 20.0f) return {};
  if (state.fit_next || (!state.touched && !state.follow)) {
    Vec2 lowest, highest;
    extent_of(scene, lowest, highest);
    const float lens = state.show_lens && scene.deviating ? lens_side(camera, theme) + theme.px(8) : 0.0f;
    camera.fit(lowest, highest, {theme.px(58), theme.px(44), theme.px(20) + lens, theme.px(34)});
    if (state.fit_next) state.touched = false;
    state.fit_next = false;
  }
  if (state.follow && !scene.vehicles.empty()) camera.centre = scene.vehicles.front().pose.position();

  ImGui::SetCursorScreenPos(camera.low);
  ImGui::InvisibleButton("floor", {camera.high.x - camera.low.x, camera.high.y - camera.low.y});
  Actions actions = react(scene, state, theme);
  append(actions, context_menu(scene, state));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(camera.low, camera.high, true);
  draw_scene(draw, scene, state, theme);
  draw.PopClipRect();
  draw.AddLine(camera.low, {camera.high.x, camera.low.y}, theme.line);
  return actions;
}

}  // namespace odolab::ui
