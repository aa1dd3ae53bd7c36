// The pages after the drive: the numbers, whether to correct once more, what is taken away.
#include <algorithm>

#include "ui/panels/guide_entry_parts.h"

namespace odolab::ui {

namespace {

constexpr float kNarrow = 470;  // a page, at scale 1

// The number with its unit as the workshop has it: millimetres, degrees.
Unit unit_of(const Setting& s) {
  if (s.unit == "rad") return {"°", kDegrees.per_si, 3, 0.0};
  if (s.unit == "m") return {"mm", 1e3, 3, 0.0};
  return {s.unit.c_str(), 1.0, 5, 0.0};
}

std::optional<double> true_value(const Setting& s, const std::optional<Vehicle>& actual) {
  const auto* drive = actual ? std::get_if<DifferentialDrive>(&actual->kind) : nullptr;
  if (!drive) return std::nullopt;
  const double times = s.file_has_half ? 2.0 : 1.0;
  if (s.key == "wheel_radius_left_m") return times * drive->wheel_radius_left_m;
  if (s.key == "wheel_radius_right_m") return times * drive->wheel_radius_right_m;
  if (s.key == "wheelbase_m") return drive->wheelbase_m;
  return std::nullopt;
}

std::string in_the_file(const Setting& s) { return "vehicle file: " + s.key + (s.file_has_half ? " (half)" : ""); }

void settings_table(const GuideView& view, bool truth, const Theme& theme) {
  const GuideOutcome& out = *view.outcome;
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
      note(in_the_file(s), theme);
      note("ROS 2: " + s.ros2, theme);
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
}

// Where a table would leave no room for words.
void settings_below_each_other(const GuideView& view, const Theme& theme) {
  for (const Setting& s : view.outcome->settings) {
    const Unit unit = unit_of(s);
    words(s.words + ": " +
              (!s.determined          ? std::string("not determined, as before")
               : s.stderr_value > 0.0 ? shown_with_error(s.value, s.stderr_value, unit, unit.decimals)
                                      : shown(s.value, unit)),
          theme.ink);
    const auto value = true_value(s, view.actual);
    note("before " + shown(s.before, unit) + (value ? ", true " + shown(*value, unit) : "") + "; " + in_the_file(s) +
             (s.ros2.empty() ? "" : "; ROS 2: " + s.ros2),
         theme);
  }
}

}  // namespace

void result_page(const GuideView& view, GuidePageState& state, const Theme& theme) {
  const GuideOutcome& out = *view.outcome;
  if (out.settings.empty()) {
    if (!out.extended) note(view.busy ? "Still reckoning…" : "There is no result yet.", theme);
    if (!out.extended) return;
    {
      WithFont large(theme.large);
      ImGui::TextUnformatted(
          (shown(out.extended->mean_absolute_heading_error_rad, kDegrees) + " for ten bumps").c_str());
    }
    note(
        "Each bump turns the robot by about a tenth of it. No setting takes this off: it is the number by which "
        "robots, "
        "and ways to reckon on one robot, are compared.",
        theme);
    clusters(view, true, state, theme);
    return;
  }
  bool ros2 = false, truth = false;
  for (const Setting& s : out.settings) {
    ros2 = ros2 || !s.ros2.empty();
    truth = truth || true_value(s, view.actual).has_value();
  }
  if (ImGui::GetContentRegionAvail().x < theme.px(kNarrow))
    settings_below_each_other(view, theme);
  else
    settings_table(view, truth, theme);
  if (ros2)
    note(
        "In ROS 2's diff_drive_controller these go into three multipliers; the last page writes them. Uncertainties "
        "are one "
        "standard deviation.",
        theme);
  else
    note("Uncertainties are one standard deviation.", theme);
  if (truth && view.rough_floor)
    note(
        "The floor is rough: wheels that climb turn further than the robot goes, as if they were smaller. What is put "
        "in "
        "holds on this floor; the true diameters are those of the wheels themselves.",
        theme);
  if (!out.rounds.empty()) clusters(view, false, state, theme);
}

Actions verdict_page(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  const GuideOutcome& out = *view.outcome;
  for (const std::string& sentence : out.verdict) {
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

Actions finish_page(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  const bool calibrated = view.outcome->calibrated.has_value();
  const bool drive = std::holds_alternative<DifferentialDrive>(view.session->vehicle.kind);
  const std::string folder = state.export_folder.empty() ? "" : state.export_folder + "/";
  const auto write = [&](const char* words, GuideExport what, const std::string& file, bool enabled, const char* why) {
    ButtonLook look;
    look.enabled = enabled;
    look.why_disabled = why;
    look.tip = "Writes " + folder + file;
    const float width = std::min(theme.px(230), 0.5f * ImGui::GetContentRegionAvail().x);
    if (text_button(words, theme, look, width)) actions.push_back(ExportGuide{what, folder + file});
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const float room = ImGui::GetContentRegionAvail().x;
    const std::string path = ImGui::CalcTextSize((folder + file).c_str()).x <= room ? folder + file : file;
    ImGui::TextDisabled("%s", fitted(path, room).c_str());
  };
  const char* none = "There is no calibration to write yet.";
  if (view.session->kind != GuideKind::extended_umbmark) {
    write("Vehicle file", GuideExport::vehicle, "calibrated_vehicle.toml", calibrated, none);
    if (drive) write("ROS 2 parameters", GuideExport::ros2, "diff_drive_controller.yaml", calibrated, none);
  }
  write("Report page", GuideExport::report, "calibration_report.html", true, "");
  return actions;
}

}  // namespace odolab::ui
