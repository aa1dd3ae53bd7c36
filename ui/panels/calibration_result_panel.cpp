#include "ui/panels/calibration_result_panel.h"

#include <algorithm>
#include <cmath>

#include "ui/look/figure_table.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

void figure_row(const char* label, const std::string& value, const std::string& tip, const Theme& theme,
                ImU32 colour = 0) {
  ImGui::TextUnformatted(label);
  tooltip(tip, theme);
  ImGui::SameLine();
  if (ImGui::CalcTextSize(value.c_str()).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
  text_right(value, colour ? colour : theme.ink);
}

void measure_block(const BenchExperiment& e, const Theme& theme) {
  if (!e.measure) return;
  const UmbmarkMeasure& m = *e.measure;
  figure_row(
      "Emax,syst", shown(m.largest_systematic_error_m, kMillimetres),
      "The measure of dead-reckoning accuracy: the larger of the two centres' distances from the origin (Eq. 3.4).",
      theme);
  figure_row("centre cw", shown_with_error(m.clockwise.distance_m, m.standard_error_m, kMillimetres, 1),
             "Distance of the clockwise runs' centre of gravity from the origin (Eq. 3.3), ± its standard error.",
             theme, theme.orange);
  figure_row(
      "centre ccw", shown_with_error(m.counter_clockwise.distance_m, m.standard_error_m, kMillimetres, 1),
      "Distance of the counter-clockwise runs' centre of gravity from the origin (Eq. 3.3), ± its standard error.",
      theme, theme.blue);
  const bool has_spread = e.runs.clockwise.size() > 1 || e.runs.counter_clockwise.size() > 1;
  figure_row("spread of runs", has_spread ? shown(m.spread_m, kMillimetres) : "unknown",
             "Standard deviation of single runs about their centre: the non-systematic errors.", theme);
}

void change_table(const BenchExperiment& e, const ActualDrive& actual, const Theme& theme) {
  const UmbmarkCalibration& c = *e.calibration;
  const Unit mm{"", 1e3, 3, 0.0}, base{"", 1e3, 2, 0.0};
  if (!begin_figures("change", {0.86f, 1.0f, 1.0f, 1.0f}, ImGuiTableFlags_BordersInnerH)) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("mm");
  for (const char* title : {"believed", "put in", "true"}) {
    ImGui::TableNextColumn();
    text_right(title, theme.muted);
  }
  tooltip(
      "Known here because the machine is simulated; a real one would not tell. The mean diameter stays as it was (Eq. "
      "6.30): squares cannot see a common scale.",
      theme);
  const auto row = [&](const char* label, double before, double after, double truth, const Unit& unit) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    figure_label(label, theme.ink);
    ImGui::TableNextColumn();
    text_right(shown(before, unit), theme.muted);
    ImGui::TableNextColumn();
    text_right(shown(after, unit), theme.ink);
    ImGui::TableNextColumn();
    text_right(shown(truth, unit), theme.muted);
  };
  row("Ø left", 2 * e.vehicle.wheel_radius_left_m, 2 * c.corrected.wheel_radius_left_m, 2 * actual.wheel_radius_left_m,
      mm);
  row("Ø right", 2 * e.vehicle.wheel_radius_right_m, 2 * c.corrected.wheel_radius_right_m,
      2 * actual.wheel_radius_right_m, mm);
  row("base", e.vehicle.wheelbase_m, c.corrected.wheelbase_m, actual.wheelbase_m, base);
  end_figures();
}

void one_direction_block(const BenchExperiment& e, const Theme& theme) {
  if (!e.only_clockwise && !e.only_counter_clockwise) return;
  heading("One direction alone", theme);
  const auto sentence = [&](const OneDirectionCalibration& o, const char* way) {
    note(std::string(way) + " squares alone would take the wheelbase " + shown(o.wheelbase_ratio, {"", 1.0, 4, 0.0}) +
             " times the nominal one, promise " + shown(o.predicted_error_this_way_m, kMillimetres) +
             " that way, and leave " + shown(o.predicted_error_other_way_m, kMillimetres) + " the other way.",
         theme);
  };
  if (e.only_clockwise) sentence(*e.only_clockwise, "Clockwise");
  if (e.only_counter_clockwise) sentence(*e.only_counter_clockwise, "Counter-clockwise");
}

}  // namespace

void calibration_result_panel(const Bench& bench, const Theme& theme) {
  const std::vector<BenchExperiment>& experiments = *bench.experiments;
  if (!bench.running && !experiments.empty() && !experiments.back().lost.empty()) {
    heading("Not all squares were closed", theme);
    warning(words_of_lost(experiments.back().lost) + ".", theme);
    note("A robot that never arrives has no return error, and the rest of such an experiment calibrates nothing.",
         theme);
    return;
  }
  if (experiments.empty() || !experiments.front().measure) {
    heading("What the squares will say", theme);
    note("Two systematic errors bend a differential drive's odometry:", theme);
    ImGui::Bullet();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted("Type A: a wrong wheelbase. Every turn is too large or too small.");
    ImGui::Bullet();
    ImGui::TextUnformatted("Type B: unequal wheels. Straight sides become arcs.");
    ImGui::PopTextWrapPos();
    note(
        "Driven one way they can cancel each other at the corner where the square ends, and a wrong correction looks "
        "perfect. Driven the other way they add up. "
        "From both centres of gravity both errors follow (J. Borenstein, L. Feng, UMBmark, 1994).",
        theme);
    return;
  }
  const BenchExperiment& first = experiments.front();
  if (experiments.size() > 1 && experiments.back().measure) {
    const BenchExperiment& last = experiments.back();
    heading("Before and after", theme);
    const double before = first.measure->largest_systematic_error_m, after = last.measure->largest_systematic_error_m;
    {
      WithFont large(theme.large);
      const std::string from = shown(before, kMillimetres), to = " → " + shown(after, kMillimetres);
      ImGui::TextUnformatted(from.c_str());
      ImGui::SameLine(0.0f, 0.0f);
      if (ImGui::CalcTextSize(to.c_str()).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
      ImGui::TextUnformatted(to.c_str());
    }
    if (const double times = std::max(before, after) / std::min(before, after); std::isfinite(times))
      note("Emax,syst, " + shown(times, {"", 1.0, times < 10 ? 1 : 0, 0.0}) +
               (after > before ? " times larger" : " times smaller"),
           theme);
    measure_block(last, theme);
  } else {
    heading("Accuracy", theme);
    measure_block(first, theme);
  }
  const BenchExperiment* shown_one = nullptr;
  for (const BenchExperiment& e : experiments)
    if (e.calibration && (!shown_one || &e != &experiments.back())) shown_one = &e;
  if (!shown_one) {
    note("The calibration follows when all squares are driven.", theme);
    return;
  }
  const UmbmarkCalibration& c = *shown_one->calibration;
  heading(shown_one == &first ? "What is wrong with the vehicle" : "What the second calibration found", theme);
  const Unit ratio{"", 1.0, 5, 0.0}, deg{"°", kDegrees.per_si, 3, 0.0};
  figure_row(
      "α each corner", shown_with_error(c.exact.alpha_rad, shown_one->alpha_stderr_rad, deg, 3),
      "Type A: heading error of each turn on the spot, above zero where it turns too little (Eq. 6.22, exact path).",
      theme);
  figure_row("β each side", shown_with_error(c.exact.beta_rad, shown_one->beta_stderr_rad, deg, 3),
             "Type B: heading error gathered on each straight side (Eq. 6.26, exact path).", theme);
  figure_row("Eb", shown_with_error(c.wheelbase_ratio, c.wheelbase_ratio_stderr, ratio, 5),
             "Wheelbase, actual over nominal (Eq. 6.29).", theme);
  figure_row("Ed", shown_with_error(c.wheel_diameter_ratio, c.wheel_diameter_ratio_stderr, ratio, 5),
             "Wheel diameters, right over left (Eq. 6.24).", theme);
  ImGui::Dummy({1, theme.px(2)});
  change_table(*shown_one, bench.actual, theme);
  if (bench.rough)
    note("Squares cannot see a common scale: what a rough floor adds to both wheels goes into the base (Eq. 6.30).",
         theme);
  one_direction_block(*shown_one, theme);
}

}  // namespace odolab::ui
