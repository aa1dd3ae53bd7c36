#include "ui/panels/guide_entries.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/look/widgets.h"
#include "ui/panels/guide_drawing.h"

namespace odolab::ui {

namespace {

const Unit kReadMillimetres{"mm", 1e3, 1, 0.2};
const Unit kSettingMillimetres{"mm", 1e3, 3, 0.01};

// Where the fields of a page begin: as far right as a narrow window allows.
float field_column(const Theme& theme) {
  return std::min(theme.px(300), ImGui::GetWindowContentRegionMax().x - theme.px(160));
}

// A labelled field in a column that is not too wide to read.
Edited row(const char* label, const NumberField& field, double& value, const Theme& theme) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  tooltip(field.tip, theme);
  ImGui::SameLine(field_column(theme));
  return number_field(field, value, theme.px(150), theme);
}

void keep(Edited edited, GuidePageState& state, Actions& actions) {
  if (edited == Edited::no) return;
  state.editing = edited == Edited::changing;
  actions.push_back(ChangeGuide{state.draft});  // half-typed numbers, too: nothing is lost
}

Actions robot(const GuideView& view, GuidePageState& state, const Theme& theme) {
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
    state.editing = true;
    actions.push_back(ChangeGuide{s});
  }
  if (auto* drive = std::get_if<DifferentialDrive>(&s.vehicle.kind)) {
    double left = 2.0 * drive->wheel_radius_left_m, right = 2.0 * drive->wheel_radius_right_m;
    Edited e = Edited::no;
    const auto field = [&](const char* id, Unit unit, double least, double most, const char* tip) {
      NumberField f{id, unit, least, most, tip};
      f.enabled = !fixed;
      return f;
    };
    e = more(e, row("Diameter of the left wheel",
                    field("##left", kSettingMillimetres, 0.002, 2.0,
                          "As the robot's odometry believes it; twice the radius."),
                    left, theme));
    e = more(e, row("Diameter of the right wheel",
                    field("##right", kSettingMillimetres, 0.002, 2.0,
                          "As the robot's odometry believes it; twice the radius."),
                    right, theme));
    e = more(e, row("Wheelbase",
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
    note("Its numbers are those of the vehicle file; open another one with File, Open, or drop it here.", theme);
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

// The button that lets the simulation do a page, with its progress.
Actions drive_button(const GuideView& view, const char* words, const Theme& theme) {
  Actions actions;
  if (view.session->real_robot) return actions;
  if (view.busy) {
    if (job_progress(view.share_done, theme, theme.px(220), theme.px(90))) actions.push_back(CancelJob{});
    return actions;
  }
  ButtonLook look;
  look.primary = true;
  look.enabled = view.can_simulate.empty();
  look.why_disabled = view.can_simulate;
  look.tip = "The simulation drives it, faster than real time.";
  if (text_button(words, theme, look, theme.px(150))) actions.push_back(DriveGuide{});
  return actions;
}

Actions tape(const GuideView& view, GuidePageState& state, const Theme& theme) {
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
  Edited e = row(
      "The odometry says",
      field("##said", {"m", 1.0, 4, 0.001}, 0.05, 1000.0, "How far the robot believes to have gone, straight ahead."),
      reading.calculated_m, theme);
  e = more(e, row("The tape says", field("##tape", {"m", 1.0, 4, 0.001}, 0.05, 1000.0, "How far it really went."),
                  reading.actual_m, theme));
  e = more(
      e, row("The tape is good to",
             field("##good", kReadMillimetres, 0.0001, 0.1, "Standard deviation of the reading; 1 to 2 mm with care."),
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
      heading("Put these diameters into the robot before the squares", theme);
      const Unit mm{"mm", 1e3, 3, 0.0};
      ImGui::TextUnformatted(("left " + shown(2.0 * scale->corrected.wheel_radius_left_m, mm) + ",  right " +
                              shown(2.0 * scale->corrected.wheel_radius_right_m, mm))
                                 .c_str());
    }
  return actions;
}

Actions what_to_drive(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  GuideSession& s = state.draft;
  if (s.kind == GuideKind::umbmark || s.kind == GuideKind::extended_umbmark) {
    const bool begun = !view.session->rounds.empty() && !view.session->rounds.front().runs.empty();
    NumberField side{"##side", kMetres, 0.2, 100.0,
                     "Side of the square. The report drives 4 m; a larger one shows errors of the wheels better."};
    side.enabled = !begun;
    Edited e = row("Side of the square", side, s.side_m, theme);
    double runs = s.runs_each_way;
    e = more(e, row("Runs each way", {"##runs", {"", 1.0, 0, 0.1}, 1.0, 50.0, "The report drives five (section 3.2)."},
                    runs, theme));
    s.runs_each_way = int(std::lround(runs));
    keep(e, state, actions);
  }
  guide_drawing(*view.session, std::clamp(ImGui::GetContentRegionAvail().y, theme.px(190), theme.px(300)), theme);
  return actions;
}

// The run that is typed next.
Actions entry_form(const GuideView& view, PageTask task, GuidePageState& state, const Theme& theme) {
  Actions actions;
  GuideSession& s = state.draft;
  const GuideRound& round = *round_on(*view.session, task);
  if (round.runs.empty() && s.draft.source.empty()) s.draft.clockwise = true;
  const bool needs_heading = s.kind == GuideKind::extended_umbmark;
  if (needs_heading) s.draft.has_heading = true;
  char title[64];
  std::snprintf(title, sizeof title, "Next run: %s %d", s.draft.clockwise ? "cw" : "ccw",
                counted(round, s.draft.clockwise) + 1);
  heading(title, theme);
  const float width = ImGui::GetContentRegionAvail().x;
  if (width > theme.px(600)) ImGui::SameLine(theme.px(190));
  if (const auto way = segmented("way", {"clockwise", "counter-clockwise"}, s.draft.clockwise ? 0 : 1, theme)) {
    s.draft.clockwise = *way == 0;
    actions.push_back(ChangeGuide{s});
  }
  if (!needs_heading) {
    if (width > theme.px(600)) ImGui::SameLine();
    if (ImGui::Checkbox("heading measured", &s.draft.has_heading)) actions.push_back(ChangeGuide{s});
    tooltip("UMBmark needs the place alone.", theme);
  }
  Edited e = Edited::no;
  const float label = std::min(theme.px(190), 0.34f * width);
  const float field = std::min(theme.px(104), 0.5f * (width - label) - theme.px(34));
  const auto pose_row = [&](const char* words, const char* tip, Pose& pose) {
    ImGui::PushID(words);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(words);
    tooltip(tip, theme);
    struct Part {
      const char* name;
      double* value;
      Unit unit;
      bool there;
    };
    const Part parts[] = {{"x", &pose.x_m, kReadMillimetres, true},
                          {"y", &pose.y_m, kReadMillimetres, true},
                          {"heading", &pose.heading_rad, kDegrees, s.draft.has_heading}};
    float x = label;
    for (const Part& part : parts) {
      if (!part.there) continue;
      const bool fits = x + ImGui::CalcTextSize(part.name).x + field < width + theme.px(30);
      if (!fits) x = label;  // on the next line
      if (fits)
        ImGui::SameLine(x);
      else
        ImGui::SetCursorPosX(x);
      ImGui::AlignTextToFramePadding();
      ImGui::TextDisabled("%s", part.name);
      x += ImGui::CalcTextSize(part.name).x + theme.px(7);
      ImGui::SameLine(x);
      const bool angle = part.name[0] == 'h';
      ImGui::PushID(part.name);
      e = more(e, number_field({"##value", part.unit, angle ? -kPi : -50.0, angle ? kPi : 50.0, tip}, *part.value,
                               field, theme));
      ImGui::PopID();
      x += field + theme.px(10);
    }
    ImGui::PopID();
  };
  pose_row("It stands at",
           "Measured from the start mark: x forward along the first side, y to its left, the heading "
           "counter-clockwise positive.",
           s.draft.measured);
  pose_row("Odometry says", "What the robot believes at the end, set to zero at the start.", s.draft.odometry);
  keep(e, state, actions);
  ButtonLook enter;
  const int cw = counted(round, true), ccw = counted(round, false), wanted = s.runs_each_way;
  enter.primary = cw < wanted || ccw < wanted;
  enter.tip = "The run becomes a point. It can be taken back from the list.";
  if (text_button("Enter this run", theme, enter, theme.px(150))) {
    GuideRun run = s.draft;
    run.source = "typed";
    run.left_out = false;
    enter_run(s, task, run);
    const bool clockwise = next_is_clockwise(*round_on(s, task));
    s.draft = GuideRun{};
    s.draft.clockwise = clockwise;
    s.draft.has_heading = run.has_heading;
    state.editing = false;
    actions.push_back(ChangeGuide{s});
  }
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%d of %d cw, %d of %d ccw%s", cw, wanted, ccw, wanted,
                      cw >= wanted && ccw >= wanted ? ": go on" : "");
  return actions;
}

// The rounds so far in the rest of the page.
void clusters(const GuideView& view, bool last_alone, GuidePageState& state, const Theme& theme) {
  if (!view.experiments) return;
  std::vector<BenchExperiment> rounds = *view.experiments;
  if (last_alone && !rounds.empty()) rounds.erase(rounds.begin(), rounds.end() - 1);
  Bench bench;
  bench.experiments = &rounds;
  bench.running = view.busy;
  ImGui::BeginChild("clusters", {0, std::max(theme.px(200), ImGui::GetContentRegionAvail().y - theme.px(4))}, false);
  cluster_panel(bench, state.clusters, theme);
  ImGui::EndChild();
}

Actions runs(const GuideView& view, PageTask task, GuidePageState& state, const Theme& theme) {
  Actions actions;
  const GuideSession& s = *view.session;
  if (task == PageTask::again && s.rounds.size() > 1) {
    const DifferentialDrive& d = s.rounds.back().nominal;
    const Unit mm{"mm", 1e3, 3, 0.0};
    note("Settings for these runs: wheels " + shown(2.0 * d.wheel_radius_left_m, mm) + " left and " +
             shown(2.0 * d.wheel_radius_right_m, mm) + " right, wheelbase " + shown(d.wheelbase_m, mm) + ".",
         theme);
  }
  append(actions, s.real_robot ? entry_form(view, task, state, theme) : drive_button(view, "Drive", theme));
  clusters(view, task == PageTask::bumps, state, theme);
  return actions;
}

// The files of a list, each of which can be taken out.
Actions file_list(const GuideView& view, std::vector<std::string> GuideSession::*list, const Theme& theme) {
  Actions actions;
  const std::vector<std::string>& files = view.session->*list;
  ImGui::Dummy({1, theme.px(4)});
  if (files.empty()) note("No recording yet.", theme);
  for (std::size_t i = 0; i < files.size(); ++i) {
    ImGui::PushID(int(i));
    ButtonLook away;
    away.enabled = !view.busy;
    away.tip = "Take this file out; the file itself stays.";
    if (text_button("Take out", theme, away, theme.px(90))) {
      GuideSession s = *view.session;
      (s.*list).erase((s.*list).begin() + long(i));
      actions.push_back(ChangeGuide{s});
    }
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(fitted(words_of_file(files[i]), ImGui::GetContentRegionAvail().x).c_str());
    tooltip(files[i], theme);
    ImGui::PopID();
  }
  return actions;
}

Actions recordings(const GuideView& view, const Theme& theme) {
  Actions actions = drive_button(view, "Drive", theme);
  if (view.session->real_robot && view.busy)
    ImGui::ProgressBar(float(view.share_done), {theme.px(220), 0.0f}, view.job.c_str());
  append(actions, file_list(view, &GuideSession::recordings, theme));
  return actions;
}

Actions held_out(const GuideView& view, const Theme& theme) {
  Actions actions = drive_button(view, "Drive", theme);
  append(actions, file_list(view, &GuideSession::held_out, theme));
  const std::vector<HeldOutError>& errors = view.outcome->held_out;
  if (errors.empty()) return actions;
  ImGui::Dummy({1, theme.px(4)});
  heading("How far the odometry ends from the truth", theme);
  if (!ImGui::BeginTable("held out", 3, ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingFixedFit)) return actions;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, theme.px(170));
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, theme.px(170));
  ImGui::TableNextRow();
  for (const char* title : {"drive", "as it was", "calibrated"}) {
    ImGui::TableNextColumn();
    if (title[0] == 'd')
      ImGui::TextDisabled("%s", title);
    else
      text_right(title, theme.muted);
  }
  for (const HeldOutError& e : errors) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(words_of_file(e.name).c_str());
    ImGui::TableNextColumn();
    text_right(shown(e.before_m, kMillimetres) + ",  " + shown(e.before_rad, kDegrees), theme.muted);
    ImGui::TableNextColumn();
    WithFont strong(theme.strong);
    text_right(shown(e.after_m, kMillimetres) + ",  " + shown(e.after_rad, kDegrees), theme.ink);
  }
  ImGui::EndTable();
  return actions;
}

// The number with its unit as the workshop has it: millimetres, degrees.
Unit unit_of(const Setting& s) {
  if (s.unit == "rad") return {"°", kDegrees.per_si, 3, 0.0};
  if (s.unit == "m") return {"mm", 1e3, 3, 0.0};
  return {s.unit.c_str(), 1.0, 5, 0.0};
}

std::optional<double> true_value(const Setting& s, const std::optional<Vehicle>& actual) {
  const auto* drive = actual ? std::get_if<DifferentialDrive>(&actual->kind) : nullptr;
  if (!drive) return std::nullopt;
  if (s.key == "wheel_radius_left_m") return drive->wheel_radius_left_m;
  if (s.key == "wheel_radius_right_m") return drive->wheel_radius_right_m;
  if (s.key == "wheelbase_m") return drive->wheelbase_m;
  return std::nullopt;
}

void result(const GuideView& view, GuidePageState& state, const Theme& theme) {
  const GuideOutcome& out = *view.outcome;
  if (out.settings.empty()) {
    if (!out.extended) note(view.busy ? "Still reckoning…" : "There is no result yet.", theme);
    if (out.extended) {
      WithFont large(theme.large);
      ImGui::TextUnformatted(
          (shown(out.extended->mean_absolute_heading_error_rad, kDegrees) + " for ten bumps").c_str());
    }
    return;
  }
  bool ros2 = false, truth = false;
  for (const Setting& s : out.settings) {
    ros2 = ros2 || !s.ros2.empty();
    truth = truth || true_value(s, view.actual).has_value();
  }
  const int columns = 4 + truth;
  if (!ImGui::BeginTable("settings", columns, ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  for (int i = 1; i < columns; ++i) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableNextRow();
  for (const char* title : {"number and setting", "before", "put in", "uncertainty"}) {
    ImGui::TableNextColumn();
    if (title[0] == 'n')
      ImGui::TextDisabled("%s", title);
    else
      text_right(title, theme.muted);
  }
  if (truth) {
    ImGui::TableNextColumn();
    text_right("true", theme.muted);
    tooltip("Known because this robot is simulated.", theme);
  }
  for (const Setting& s : out.settings) {
    const Unit unit = unit_of(s);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(s.words.c_str());
    if (!s.ros2.empty()) {
      ImGui::TextDisabled("vehicle file: %s", s.key.c_str());
      ImGui::TextDisabled("ROS 2: %s", s.ros2.c_str());
    } else {
      tooltip(s.key, theme);
    }
    ImGui::TableNextColumn();
    text_right(shown(s.before, unit), theme.muted);
    ImGui::TableNextColumn();
    {
      WithFont strong(theme.strong);
      text_right(s.determined ? shown(s.value, unit) : "as before", s.determined ? theme.ink : theme.muted);
    }
    ImGui::TableNextColumn();
    text_right(!s.determined          ? "not determined"
               : s.stderr_value > 0.0 ? "± " + shown(s.stderr_value, unit)
                                      : "unknown",
               theme.muted);
    if (truth) {
      ImGui::TableNextColumn();
      const auto value = true_value(s, view.actual);
      text_right(value ? shown(*value, unit) : "", theme.muted);
    }
  }
  ImGui::EndTable();
  if (ros2)
    note(
        "In ROS 2's diff_drive_controller these go into three multipliers; the last page writes them. Uncertainties "
        "are one "
        "standard deviation.",
        theme);
  else
    note("Uncertainties are one standard deviation.", theme);
  if (!out.rounds.empty()) clusters(view, false, state, theme);
}

Actions verdict(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  const GuideOutcome& out = *view.outcome;
  for (const std::string& sentence : out.sentences)
    if (sentence.find("standard error") != std::string::npos || sentence.find("times smaller") != std::string::npos) {
      WithFont strong(theme.strong);
      words(sentence, theme.ink);
    }
  ButtonLook again;
  again.primary = out.compensate_again;
  again.enabled = out.compensate_again && !view.busy;
  again.tip = "Corrects once more from the runs of the calibrated robot, and drives again.";
  again.why_disabled = "Below three standard errors a second compensation would fit chance (section 6.3).";
  if (text_button("Compensate a second time", theme, again, theme.px(230))) {
    GuideSession s = *view.session;
    if (compensate(s)) {
      --s.page;  // back to the squares, with the new settings
      actions.push_back(ChangeGuide{s});
    }
  }
  clusters(view, false, state, theme);
  return actions;
}

Actions finish(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  const bool calibrated = view.outcome->calibrated.has_value();
  const bool drive = std::holds_alternative<DifferentialDrive>(view.session->vehicle.kind);
  const std::string folder = state.export_folder.empty() ? "" : state.export_folder + "/";
  const auto write = [&](const char* words, GuideExport what, const std::string& file, bool enabled, const char* why) {
    ButtonLook look;
    look.enabled = enabled;
    look.why_disabled = why;
    look.tip = "Writes " + folder + file;
    if (text_button(words, theme, look, theme.px(230))) actions.push_back(ExportGuide{what, folder + file});
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", fitted(folder + file, ImGui::GetContentRegionAvail().x).c_str());
  };
  const char* none = "There is no calibration to write yet.";
  if (view.session->kind != GuideKind::extended_umbmark) {
    write("Vehicle file", GuideExport::vehicle, "calibrated_vehicle.toml", calibrated, none);
    if (drive) write("ROS 2 parameters", GuideExport::ros2, "diff_drive_controller.yaml", calibrated, none);
  }
  write("Report page", GuideExport::report, "calibration_report.html", true, "");
  return actions;
}

}  // namespace

Actions guide_entries(const GuideView& view, PageTask task, GuidePageState& state, const Theme& theme) {
  ImGui::Dummy({1, theme.px(2)});
  switch (task) {
    case PageTask::robot:
      return robot(view, state, theme);
    case PageTask::tape:
      return tape(view, state, theme);
    case PageTask::drive:
      return what_to_drive(view, state, theme);
    case PageTask::runs:
    case PageTask::bumps:
    case PageTask::again:
      return runs(view, task, state, theme);
    case PageTask::recordings:
      return recordings(view, theme);
    case PageTask::held_out:
      return held_out(view, theme);
    case PageTask::result:
      result(view, state, theme);
      return {};
    case PageTask::verdict:
      return verdict(view, state, theme);
    case PageTask::finish:
      return finish(view, state, theme);
  }
  return {};
}

}  // namespace odolab::ui
