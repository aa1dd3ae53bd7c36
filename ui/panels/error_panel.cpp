#include "ui/panels/error_panel.h"

#include <cmath>

#include "ui/look/figure_table.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

void figure_table(const char* id, const Compare& c, const char* title, const ComparedTrack ReplayFigures::*which,
                  ImU32 colour, const std::string& tip, const Theme& theme) {
  ImGui::Dummy({1, theme.px(2)});
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  {
    WithFont strong(theme.strong);
    ImGui::TextUnformatted(title);
  }
  ImGui::PopStyleColor();
  tooltip(tip, theme);
  if (!begin_figures(id, {1.05f, 1.0f, 1.0f})) return;
  const auto column = [&](const std::optional<ReplayFigures>& f, auto text) -> std::string {
    if (!f || !((*f).*which).error) return "–";
    return text(*((*f).*which).error);
  };
  const auto row = [&](const char* label, const char* row_tip, auto text) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    figure_label(label, theme.ink);
    tooltip(row_tip, theme);
    ImGui::TableNextColumn();
    text_right(column(c.nominal, text), c.vehicle == ReplayVehicle::nominal ? theme.ink : theme.muted);
    ImGui::TableNextColumn();
    text_right(column(c.calibrated, text), c.vehicle == ReplayVehicle::calibrated ? theme.ink : theme.muted);
  };
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  text_right("nominal", theme.muted);
  ImGui::TableNextColumn();
  text_right("calibrated", theme.muted);
  row("over 1 m", "Position error gathered over one metre or one radian, from a true start: root mean square.",
      [](const TrackError& e) { return shown_length(e.position_rms_m); });
  row("", "Heading error gathered over one metre or one radian, from a true start: root mean square.",
      [](const TrackError& e) { return shown(e.heading_rms_rad, kDegrees); });
  row("at the end", "Position error at the end of the run.",
      [](const TrackError& e) { return shown_length(e.end_position_m); });
  row("", "Heading error at the end of the run.",
      [](const TrackError& e) { return shown(e.end_heading_rad, kDegrees); });
  row("largest", "Largest position error on the way.",
      [](const TrackError& e) { return shown_length(e.largest_position_m); });
  end_figures();
}

}  // namespace

void error_panel(const Compare& c, const ErrorNow& now, const Theme& theme) {
  if (!c.loaded) {
    heading("What you will see", theme);
    note(
        "The recorded truth in ink, the simulated track in orange dashes, dead reckoning in blue; their errors over "
        "time below, and two figures: the error gathered over one metre, and the one at the end.",
        theme);
    return;
  }
  if (c.nominal && c.truth_samples == 0) {
    heading("Nothing to compare with", theme);
    note(
        "This recording holds no outside measurement of where the robot was. The tracks are what the simulation and "
        "dead reckoning make of what it did record; how far they are from the truth, nobody can tell.",
        theme);
    return;
  }
  heading("Gap of the simulation, now", theme);
  if (now.truth && now.simulated) {
    WithFont large(theme.large);
    ImGui::PushStyleColor(ImGuiCol_Text, theme.orange);
    const std::string turned = "   " + shown(now.simulated_gap_heading_rad, kDegrees);
    ImGui::TextUnformatted(shown_length(now.simulated_gap_m).c_str());
    ImGui::SameLine(0.0f, 0.0f);
    if (ImGui::CalcTextSize(turned.c_str()).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
    ImGui::TextUnformatted(turned.c_str());
    ImGui::PopStyleColor();
  } else {
    note("No truth at this time.", theme);
  }
  heading("Error against the recorded truth", theme);
  figure_table("simulated", c, "simulation", &ReplayFigures::simulated, theme.orange,
               "The planar physics, its wheels driven as recorded.", theme);
  figure_table(
      "dead", c, c.estimator.c_str(), &ReplayFigures::dead_reckoning, theme.blue,
      "Odometry on the same inputs, without any physics; of a differential drive the UMBmark report's Eqs. 2.1 to 2.6.",
      theme);
  const auto end_of = [](const std::optional<ReplayFigures>& f) {
    return f && f->simulated.error ? f->simulated.error->end_position_m : 0.0;
  };
  if (c.nominal && c.calibrated && end_of(c.calibrated) > end_of(c.nominal)) {
    ImGui::Dummy({1, theme.px(4)});
    note("Where one run ends is a matter of luck; the figure over 1 m is the one to trust.", theme);
  }
  if (!c.calibrated && c.can_calibrate) {
    ImGui::Dummy({1, theme.px(4)});
    note("Calibrate from this recording, on the left, to see what part of the error is a wrong parameter.", theme);
  }
}

}  // namespace odolab::ui
