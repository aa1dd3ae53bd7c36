#include "ui/panels/floor_view.h"

#include <algorithm>
#include <cmath>

#include "ui/floor/drawing.h"
#include "ui/floor/lens.h"
#include "ui/floor/vehicle_drawing.h"
#include "ui/look/strokes.h"
#include "ui/look/widgets.h"
#include "ui/panels/floor_legend.h"
#include "ui/panels/floor_toolbar.h"

namespace odolab::ui {

namespace {

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
  for (const FloorDisc& disc : scene.discs) take(disc.centre, disc.radius_m);
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

// Its label stands above it, or below where the legend, which ends at `legend_y`, lies there.
void draw_disc(ImDrawList& draw, const Camera& camera, const FloorDisc& disc, float legend_y, const Theme& theme) {
  const ImVec2 at = camera.screen(disc.centre);
  const float radius = std::max(theme.px(8), float(disc.radius_m * camera.px_per_m));
  std::vector<ImVec2> rim;
  for (int i = 0; i <= 64; ++i) {
    const float a = float(i) / 64.0f * 6.2831853f;
    rim.push_back({at.x + radius * std::cos(a), at.y + radius * std::sin(a)});
  }
  dashed_line(draw, rim, theme.blue, theme.px(2), theme.px(6), theme.px(4));
  const ImVec2 size = ImGui::CalcTextSize(disc.label.c_str());
  const float above = at.y - radius - size.y - theme.px(5), below = at.y + radius + theme.px(4);
  const ImVec2 text{std::round(at.x - 0.5f * size.x), std::round(above > legend_y ? above : below)};
  if (at.y < legend_y) return;  // it is out of sight itself
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
  const float legend_y = camera.low.y + floor_legend(nullptr, scene, state, theme);
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
    for (const FloorDisc& disc : scene.discs) draw_disc(draw, camera, disc, legend_y, theme);
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
    const std::string words = wrapped_at(scene.empty_text, camera.high.x - camera.low.x - theme.px(32));
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    const ImVec2 at{std::round(0.5f * (camera.low.x + camera.high.x - size.x)),
                    std::round(0.5f * (camera.low.y + camera.high.y - size.y))};
    draw.AddRectFilled({at.x - theme.px(10), at.y - theme.px(6)},
                       {at.x + size.x + theme.px(10), at.y + size.y + theme.px(6)}, theme.paper, theme.px(4));
    draw.AddText(at, theme.muted, words.c_str());
  }
  floor_legend(&draw, scene, state, theme);
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
  close_on_escape();
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
  floor_toolbar(state, scene, theme);
  Camera& camera = state.camera;
  camera.low = {low.x, low.y + bar};
  camera.high = {low.x + size.x, low.y + size.y};
  if (camera.high.x - camera.low.x < 20.0f || camera.high.y - camera.low.y < 20.0f) return {};
  if (state.fit_next || (!state.touched && !state.follow)) {
    Vec2 lowest, highest;
    extent_of(scene, lowest, highest);
    const float lens = state.show_lens && scene.deviating ? lens_side(camera, theme) + theme.px(8) : 0.0f;
    const float label = scene.discs.empty() ? 0.0f : ImGui::GetTextLineHeight() + theme.px(6);
    const float above = std::max(theme.px(44), floor_legend(nullptr, scene, state, theme) + theme.px(8) + label);
    camera.fit(lowest, highest, {theme.px(58), above, theme.px(20) + lens, theme.px(34)});
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
