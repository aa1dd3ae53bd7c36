#include "ui/panels/calibrate_panel.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/guide/rest.h"
#include "ui/look/figure_table.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

// A step of the guide with its number in a disc: done, under way, or still to come.
void step_heading(int number, const char* title, bool done, bool now, const Theme& theme) {
  ImGui::Dummy({1, theme.px(3)});
  const float side = ImGui::GetFrameHeight() * 0.95f;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 centre{at.x + 0.5f * side, at.y + 0.5f * side};
  if (now || done)
    draw.AddCircleFilled(centre, 0.5f * side, done && !now ? theme.muted : theme.ink);
  else
    draw.AddCircle(centre, 0.5f * side - 1, theme.line, 0, theme.px(1.5f));
  const std::string text = std::to_string(number);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  draw.AddText({std::round(centre.x - 0.5f * size.x), std::round(centre.y - 0.5f * size.y)},
               now || done ? theme.on_ink : theme.muted, text.c_str());
  ImGui::Dummy({side, side});
  ImGui::SameLine();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 0.5f * (side - ImGui::GetTextLineHeight()));
  WithFont strong(theme.strong);
  words(title, now || done ? theme.ink : theme.muted);
}

void run_table(const BenchExperiment& experiment, const Theme& theme) {
  const Unit mm{"", 1e3, 1, 0.0}, deg{"°", kDegrees.per_si, 2, 0.0};
  if (!begin_figures("runs", {0.7f, 1.0f, 1.0f, 1.0f}, ImGuiTableFlags_BordersInnerH)) return;
  ImGui::TableNextRow();
  for (const char* title : {"run", "x mm", "y mm", "heading"}) {
    ImGui::TableNextColumn();
    if (title[0] == 'r')
      ImGui::TextDisabled("%s", title);
    else
      text_right(title, theme.muted);
  }
  tooltip("Return errors: absolute minus calculated pose at the end of a run, Eq. 3.1.", theme);
  const auto rows = [&](const std::vector<ReturnError>& errors, bool clockwise, ImU32 colour) {
    const auto is_lost = [&](int number) {
      for (const LostRun& l : experiment.lost)
        if (l.clockwise == clockwise && l.number == number) return true;
      return false;
    };
    int most_lost = 0;
    for (const LostRun& l : experiment.lost)
      if (l.clockwise == clockwise) most_lost = std::max(most_lost, l.number);
    std::size_t arrived = 0;
    for (int number = 1; arrived < errors.size() || number <= most_lost; ++number) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      figure_label(formatted("%s %d", clockwise ? "cw" : "ccw", number), colour);
      ImGui::TableNextColumn();
      if (is_lost(number)) {
        text_right("lost", theme.error);
        tooltip("The robot never arrived: this run has no return error.", theme);
        continue;
      }
      if (arrived == errors.size()) continue;
      const ReturnError& e = errors[arrived++];
      text_right(shown(e.x_m, mm), theme.ink);
      ImGui::TableNextColumn();
      text_right(shown(e.y_m, mm), theme.ink);
      ImGui::TableNextColumn();
      text_right(shown(e.heading_rad, deg), theme.ink);
    }
  };
  rows(experiment.runs.clockwise, true, theme.orange);
  rows(experiment.runs.counter_clockwise, false, theme.blue);
  end_figures();
}

}  // namespace

Actions calibrate_panel(const Bench& bench, CalibrateState& state, const Theme& theme) {
  Actions actions;
  const std::vector<BenchExperiment>& experiments = *bench.experiments;
  const std::size_t n = experiments.size();
  const bool lost = n > 0 && !bench.running && !experiments.back().lost.empty();
  const bool measured = n > 0 && experiments.front().calibration.has_value();
  const bool applied = n > 1, verified = applied && experiments.back().calibration.has_value();
  const float width = ImGui::GetContentRegionAvail().x;

  heading("UMBmark", theme);
  note("Squares driven both ways show the systematic errors of " + bench.vehicle_name + "; one way alone hides them.",
       theme);

  step_heading(1, "Drive squares both ways", measured, !measured, theme);
  if (!measured || n == 1) {
    const std::string words =
        formatted("%g m square, stop and turn on the spot at each corner; the return error is measured.", bench.side_m);
    if (!measured) note(words, theme);
    if (!bench.running && !measured && !lost)
      count_row("Runs each way", "##runs", state.runs_each_way, 1, 50,
                "The report drives five in each direction (section 3.2).", theme);
    if (!bench.running && !measured && !lost && bench.has_things) {
      ImGui::Checkbox("Keep cables and patches", &state.keep_things);
      tooltip("UMBmark asks for a smooth floor: cables and patches are taken away for its runs unless this is ticked.",
              theme);
    }
  }
  if (n == 0) {
    ButtonLook start;
    start.primary = true;
    start.enabled = bench.can_run;
    start.tip = "Drive the benchmark in the simulation, faster than real time.";
    start.why_disabled = bench.why_not;
    if (text_button("Start", theme, start, width))
      actions.push_back(StartBenchmark{state.runs_each_way, state.keep_things});
    if (!bench.can_run && !bench.running) note(bench.why_not, theme);
  }

  step_heading(2, "Calibrate and drive again", verified, measured && !verified, theme);
  if (measured && !applied && !bench.running) {
    note("Put the corrected wheelbase and wheel diameters into the odometry and drive the same squares.", theme);
    ButtonLook apply;
    apply.primary = true;
    apply.tip = "The corrected vehicle is driven through the same squares; before and after come into one plot.";
    if (text_button("Apply and drive again", theme, apply, width)) actions.push_back(ApplyCalibration{});
  }
  step_heading(3, "Keep it", false, verified, theme);
  if (verified && !bench.running) {
    const RestOfCalibration rest = experiments.back().measure
                                       ? rest_of(*experiments.back().measure, experiments.back().runs)
                                       : RestOfCalibration{};
    const bool again = rest.worth_another;
    note(rest.sentence, theme);
    ButtonLook second;
    second.primary = again;
    second.enabled = again;
    second.tip = "Calibrate once more, from the runs of the calibrated vehicle.";
    second.why_disabled = "Another calibration would fit chance (section 6.3).";
    if (text_button("Calibrate a second time", theme, second, width)) actions.push_back(ApplyCalibration{});
    ButtonLook keep;
    keep.primary = !again;
    keep.tip = "The calibrated vehicle becomes the nominal one of the scenario, in Drive and when it is saved.";
    if (text_button("Drive with this vehicle", theme, keep, width)) actions.push_back(AdoptCalibration{});
  }
  if (lost)
    warning(words_of_lost(experiments.back().lost) +
                ": no return error, and no calibration from the rest. Look at the floor and the drive, and start anew.",
            theme);
  if (bench.running) {
    ImGui::Dummy({1, theme.px(4)});
    if (job_progress(bench.share_done, theme, width - theme.px(84))) actions.push_back(CancelJob{});
  }
  if (n > 0) {
    ImGui::Dummy({1, theme.px(4)});
    const bool open = section(("Runs, " + experiments.back().name).c_str(), theme);
    if (open) run_table(experiments.back(), theme);
    if (!bench.running && text_button("Start anew", theme, {}, width)) actions.push_back(ClearBenchmark{});
  }
  return actions;
}

}  // namespace odolab::ui
