#include "ui/panels/path_panel.h"

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

Path default_path(int kind) {
  switch (kind) {
    case 0:
      return SquarePath{};
    case 1:
      return StraightPath{};
    case 2:
      return FigureEightPath{};
    case 3:
      return WaypointPath{{{2.0, 0.0}, {2.0, 2.0}, {0.0, 1.0}, {0.0, 0.0}}};
    case 4:
      return WheelSpeedPath{{{5.0, 2.0, 3.0}, {5.0, 3.0, 2.0}}, 0.5};
    case 6:
      return RectanglePath{};
    case 7:
      return ManoeuvrePath{{{2.0, 0.0, 0.0}, {0.0, 0.0, 0.5 * kPi}}};
    default:
      return HandPath{};
  }
}

// The figures of each kind of path.
struct PathFields {
  const Theme& theme;

  Edited operator()(SquarePath& p) const {
    Edited result = number_row(
        "Side",
        {"##side", kMetres, 0.1, 1000.0, "Length of a side; the UMBmark square has 4 m (section 3 of the report)."},
        p.side_m, theme);
    const int way = p.clockwise ? 1 : 0;
    if (const auto choice =
            segmented("way", {"counter-clockwise", "clockwise"}, way, theme, ImGui::GetContentRegionAvail().x)) {
      p.clockwise = *choice == 1;
      result = Edited::done;
    }
    return result;
  }
  Edited operator()(StraightPath& p) const {
    Edited result = number_row("Length", {"##length", kMetres, 0.1, 10000.0, "Length of the way."}, p.length_m, theme);
    if (ImGui::Checkbox("There and back", &p.there_and_back)) result = Edited::done;
    tooltip("The way back is driven in reverse.", theme);
    return result;
  }
  Edited operator()(FigureEightPath& p) const {
    Edited result = number_row("Radius", {"##radius", kMetres, 0.1, 100.0, "Radius of each circle of the eight."},
                               p.radius_m, theme);
    return more(result, count_row("Loops", "##loops", p.loops, 1, 1000, "How often the eight is driven.", theme));
  }
  Edited operator()(WaypointPath& p) const {
    Edited result = Edited::no;
    std::size_t remove = p.points.size();
    for (std::size_t i = 0; i < p.points.size(); ++i) {
      ImGui::PushID(int(i));
      const float width = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
      const float field = 0.5f * (width - ImGui::GetFrameHeight() * 1.15f - 2.0f * gap);
      result = more(result, number_field({"##x", {"m", 1.0, 2, 0.01}, 0.0, 0.0, "x of this point"}, p.points[i].x_m,
                                         field, theme));
      ImGui::SameLine();
      result = more(result, number_field({"##y", {"m", 1.0, 2, 0.01}, 0.0, 0.0, "y of this point"}, p.points[i].y_m,
                                         field, theme));
      ImGui::SameLine();
      ButtonLook look;
      look.enabled = p.points.size() > 1;
      look.tip = "Take this point away";
      look.why_disabled = "A path needs one point or more.";
      if (icon_button("remove", Icon::close, theme, look)) remove = i;
      ImGui::PopID();
    }
    if (remove < p.points.size()) {
      p.points.erase(p.points.begin() + long(remove));
      result = Edited::done;
    }
    if (text_button("Add a point", theme, {}, -1.0f)) {
      const Vec2 last = p.points.empty() ? Vec2{} : p.points.back();
      p.points.push_back(last + Vec2{1.0, 0.0});
      result = Edited::done;
    }
    return result;
  }
  Edited operator()(WheelSpeedPath& p) const {
    Edited result = number_row("Ramp", {"##ramp", kSeconds, 0.0, 60.0, "Time over which each new speed is reached."},
                               p.ramp_s, theme);
    for (std::size_t i = 0; i < p.phases.size(); ++i) {
      ImGui::PushID(int(i));
      const float third = (ImGui::GetContentRegionAvail().x - 2.0f * ImGui::GetStyle().ItemSpacing.x) / 3.0f;
      result = more(result, number_field({"##t", {"s", 1.0, 1, 0.05}, 0.05, 1e5, "How long these speeds are held."},
                                         p.phases[i].duration_s, third, theme));
      ImGui::SameLine();
      result = more(result, number_field({"##l", {"rad/s", 1.0, 1, 0.02}, -100.0, 100.0, "Left wheel."},
                                         p.phases[i].left_radps, third, theme));
      ImGui::SameLine();
      result = more(result, number_field({"##r", {"rad/s", 1.0, 1, 0.02}, -100.0, 100.0, "Right wheel."},
                                         p.phases[i].right_radps, third, theme));
      ImGui::PopID();
    }
    return result;
  }
  Edited operator()(HandPath& p) const {
    note("Drive with the arrow keys or W A S D.", theme);
    return number_row("Longest", {"##longest", {"s", 1.0, 0, 1.0}, 1.0, 36000.0, "The run ends after this time."},
                      p.duration_s, theme);
  }
  Edited operator()(RectanglePath& p) const {
    Edited result =
        number_row("Length", {"##length", kMetres, 0.1, 1000.0, "First and third side."}, p.length_m, theme);
    result = more(result,
                  number_row("Width", {"##width", kMetres, 0.1, 1000.0, "Second and fourth side."}, p.width_m, theme));
    return more(result, number_row("Corner", {"##corner", kMetres, 0.01, 100.0, "Radius of the corners."},
                                   p.corner_radius_m, theme));
  }
  Edited operator()(ManoeuvrePath& p) const {
    Edited result = Edited::no;
    for (std::size_t i = 0; i < p.moves.size(); ++i) {
      ImGui::PushID(int(i));
      const float third = (ImGui::GetContentRegionAvail().x - 2.0f * ImGui::GetStyle().ItemSpacing.x) / 3.0f;
      result = more(result, number_field({"##f", {"m", 1.0, 2, 0.01}, 0.0, 0.0, "Way forward."}, p.moves[i].forward_m,
                                         third, theme));
      ImGui::SameLine();
      result = more(result, number_field({"##l", {"m", 1.0, 2, 0.01}, 0.0, 0.0, "Way to the left."}, p.moves[i].left_m,
                                         third, theme));
      ImGui::SameLine();
      result = more(result, number_field({"##t", kDegrees, 0.0, 0.0, "Then a turn on the spot."}, p.moves[i].turn_rad,
                                         third, theme));
      ImGui::PopID();
    }
    return result;
  }
  Edited operator()(ReplayPath& p) const {
    note("As recorded in " + p.recording, theme);
    return Edited::no;
  }
};

Edited driving_fields(Scenario& s, const Theme& theme) {
  Edited result =
      number_row("Speed", {"##speed", kSpeed, 0.01, 10.0, "Speed on straight lines."}, s.driving.speed_mps, theme);
  result = more(result, number_row("Turn rate", {"##turn", kTurnRate, 0.01, 20.0, "Turn rate on the spot."},
                                   s.driving.turn_rate_radps, theme));
  result =
      more(result, number_row("Acceleration",
                              {"##acceleration", kAcceleration, 0.005, 50.0, "How quickly it gains and loses speed."},
                              s.driving.acceleration_mps2, theme));
  result = more(result,
                number_row("Turn accel.",
                           {"##turnacc", kTurnAcceleration, 0.01, 200.0, "How quickly it gains and loses turn rate."},
                           s.driving.turn_acceleration_radps2, theme));
  return more(
      result,
      number_row("Stands",
                 {"##stands", {"s", 1.0, 1, 0.1}, 0.0, 3600.0, "Before it sets off, and again at the end of its way."},
                 s.driving.stands_s, theme));
}

}  // namespace

Actions path_panel(Scenario& draft, bool& editing, const Theme& theme) {
  Actions actions;
  Edited result = Edited::no;
  ImGui::PushID("path");
  if (section("Path", theme)) {
    ImGui::SetNextItemWidth(-1.0f);
    int kind = int(draft.path.index());
    const bool replay = std::holds_alternative<ReplayPath>(draft.path);
    if (ImGui::Combo(
            "##kind", &kind,
            replay ? "Square\0Straight\0Figure-eight\0Waypoints\0Wheel speeds\0By hand\0Rectangle\0Manoeuvres\0Replay\0"
                   : "Square\0Straight\0Figure-eight\0Waypoints\0Wheel speeds\0By hand\0Rectangle\0Manoeuvres\0") &&
        kind < 8) {
      draft.path = default_path(kind);
      if (kind != 0) draft.benchmark.reset();
      result = Edited::done;
    }
    result = more(result, std::visit(PathFields{theme}, draft.path));
    if (ImGui::TreeNodeEx("Speeds", ImGuiTreeNodeFlags_NoTreePushOnOpen))
      result = more(result, driving_fields(draft, theme));
  }
  ImGui::PopID();
  if (result == Edited::changing) editing = true;
  if (result == Edited::done) actions.push_back(EditScenario{draft});
  return actions;
}

}  // namespace odolab::ui
