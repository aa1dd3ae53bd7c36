// The pages before the drive: the robot, the tape, what to drive.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/panels/guide_drawing.h"
#include "ui/panels/guide_entry_parts.h"

namespace odolab::ui {

namespace {

const Unit kSettingMillimetres{"mm", 1e3, 3, 0.01};

// Where the fields of a page begin: as far right as a narrow window allows.
float field_column(const Theme& theme) {
  return std::min(theme.px(300), ImGui::GetWindowContentRegionMax().x - theme.px(160));
}

// A labelled field in a column that is not too wide to read; narrower, and then below its label, where the page is too
// narrow for both.
Edited guide_row(const char* label, const NumberField& field, double& value, const Theme& theme) {
  const float begin = ImGui::GetCursorPosX(), column = field_column(theme);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  tooltip(field.tip, theme);
  const float right = column + theme.px(150), beside = begin + ImGui::CalcTextSize(label).x + theme.px(8);
  const bool has_room = beside <= right - theme.px(104);
  const float left = has_room ? std::max(column, beside) : column;
  if (has_room)
    ImGui::SameLine(left);
  else
    ImGui::SetCursorPosX(left);
  return number_field(field, value, right - left, theme);
}

}  // namespace

Actions robot_page(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  GuideSession& s = state.draft;
  const bool fixed = !view.session->rounds.empty() && !view.session->rounds.front().runs.empty();
  char name[128];
  std::snprintf(name, sizeof name, "%s", s.vehicle.name.c_str());
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Name");
  ImGui::SameLine(field_column(theme));
  ImGui::SetNextItemWidth(theme.px(150));
  if (ImGui::InputText("##name", name, sizeof name)) {
    s.vehicle.name = name;
    actions.push_back(ChangeGuide{s, state.editing ? GuideEdit::goes_on : GuideEdit::edit});
    state.editing = true;
  }
  if (auto* drive = std::get_if<DifferentialDrive>(&s.vehicle.kind)) {
    double left = 2.0 * drive->wheel_radius_left_m, right = 2.0 * drive->wheel_radius_right_m;
    Edited e = Edited::no;
    const auto field = [&](const char* id, Unit unit, double least, double most, const char* tip) {
      NumberField f{id, unit, least, most, tip};
      f.enabled = !fixed;
      return f;
    };
    e = more(e, guide_row("Diameter of the left wheel",
                          field("##left", kSettingMillimetres, 0.002, 2.0,
                                "As the robot's odometry believes it; twice the radius."),
                          left, theme));
    e = more(e, guide_row("Diameter of the right wheel",
                          field("##right", kSettingMillimetres, 0.002, 2.0,
                                "As the robot's odometry believes it; twice the radius."),
                          right, theme));
    e = more(
        e, guide_row("Wheelbase",
                     field("##base", kSettingMillimetres, 0.01, 10.0,
                           "Distance of the two points where the wheels touch the floor, as the odometry believes it."),
                     drive->wheelbase_m, theme));
    drive->wheel_radius_left_m = 0.5 * left;
    drive->wheel_radius_right_m = 0.5 * right;
    keep(e, state, actions);
    if (fixed)
      note("Runs were driven with these numbers, so they stay. To begin with others, leave and start a new session.",
           theme);
  } else {
    note(view.session->real_robot ? "Its numbers are those of the vehicle file."
                                  : "Its numbers are those of the vehicle file; open another one with File, Open, or "
                                    "drop it here.",
         theme);
  }
  if (view.session->real_robot && !fixed) {
    ButtonLook open;
    open.tip = "A vehicle file (TOML), which can also be dropped here (Ctrl+O)";
    if (text_button("Open a vehicle file…", theme, open)) state.ask_for_file = true;
  }
  if (view.session->real_robot && !fixed && !view.vehicle_files.empty()) {
    ImGui::Dummy({1, theme.px(6)});
    heading("Or take one that comes with OdoLab", theme);
    float x = 0.0f;
    const float room = ImGui::GetContentRegionAvail().x;
    for (const std::string& path : view.vehicle_files) {
      const std::string words = words_of_file(path);
      const float width = ImGui::CalcTextSize(words.c_str()).x + theme.px(24);
      if (x > 0.0f && x + width < room) ImGui::SameLine();
      if (x + width >= room) x = 0.0f;
      x += width + theme.px(8);
      ImGui::PushID(path.c_str());
      if (text_button(words.c_str(), theme, {}, width)) actions.push_back(ChooseGuideVehicle{path});
      ImGui::PopID();
    }
  }
  return actions;
}

Actions tape_page(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  GuideSession& s = state.draft;
  const bool fixed = !view.session->rounds.empty() && !view.session->rounds.front().runs.empty();
  TapeReading reading = s.tape.value_or(TapeReading{4.0, 4.0, 0.002});
  append(actions, drive_button(view, "Drive 4 m", theme));
  const auto field = [&](const char* id, Unit unit, double least, double most, const char* tip) {
    NumberField f{id, unit, least, most, tip};
    f.enabled = !fixed && s.tape.has_value();
    return f;
  };
  bool has_tape = s.tape.has_value();
  ImGui::BeginDisabled(fixed);
  if (ImGui::Checkbox("A tape was read", &has_tape)) {
    s.tape = has_tape ? std::optional<TapeReading>(reading) : std::nullopt;
    actions.push_back(ChangeGuide{s});
  }
  ImGui::EndDisabled();
  Edited e = guide_row(
      "The odometry says",
      field("##said", {"m", 1.0, 4, 0.001}, 0.05, 1000.0, "How far the robot believes to have gone, straight ahead."),
      reading.calculated_m, theme);
  e = more(e, guide_row("The tape says", field("##tape", {"m", 1.0, 4, 0.001}, 0.05, 1000.0, "How far it really went."),
                        reading.actual_m, theme));
  e = more(e, guide_row("The tape is good to",
                        field("##good", kReadMillimetres, 0.0001, 0.1,
                              "Standard deviation of the reading; 1 to 2 mm with care."),
                        reading.tape_accuracy_m, theme));
  if (e != Edited::no && has_tape) s.tape = reading;
  keep(e, state, actions);
  if (fixed) note("Runs were driven with this scale, so it stays.", theme);
  if (!s.tape) {
    note("Without it the squares find the ratio of the wheels and the wheelbase in units of the mean wheel.", theme);
    return actions;
  }
  if (const auto* drive = std::get_if<DifferentialDrive>(&s.vehicle.kind))
    if (const auto scale = calibrate_scale(*s.tape, *drive)) {
      ImGui::Dummy({1, theme.px(4)});
      note("Es, believed over real (Eq. B.1): " +
               shown_with_error(scale->scaling_error, scale->scaling_error_stderr, {"", 1.0, 5, 0.0}, 5),
           theme);
      const Unit mm{"mm", 1e3, 3, 0.0};
      const auto diameters = [&](const DifferentialDrive& d) {
        return "left " + shown(2.0 * d.wheel_radius_left_m, mm) + ",  right " + shown(2.0 * d.wheel_radius_right_m, mm);
      };
      const std::string corrected = diameters(scale->corrected);
      heading(corrected == diameters(*drive) ? "The diameters stay as they are"
              : view.session->real_robot     ? "Put these diameters into the robot before the squares"
                                             : "With these diameters the squares will be driven",
              theme);
      words(corrected, theme.ink);
    }
  return actions;
}

Actions drive_page(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  GuideSession& s = state.draft;
  if (s.kind == GuideKind::umbmark || s.kind == GuideKind::extended_umbmark) {
    const bool begun = !view.session->rounds.empty() && !view.session->rounds.front().runs.empty();
    NumberField side{"##side", kMetres, 0.2, 100.0,
                     "Side of the square. The report drives 4 m; a larger one shows errors of the wheels better."};
    side.enabled = !begun;
    Edited e = guide_row("Side of the square", side, s.side_m, theme);
    double runs = s.runs_each_way;
    e = more(
        e, guide_row("Runs each way", {"##runs", {"", 1.0, 0, 0.1}, 1.0, 50.0, "The report drives five (section 3.2)."},
                     runs, theme));
    s.runs_each_way = int(std::lround(runs));
    keep(e, state, actions);
  }
  guide_drawing(*view.session, std::clamp(ImGui::GetContentRegionAvail().y, theme.px(190), theme.px(300)), theme);
  return actions;
}

}  // namespace odolab::ui
