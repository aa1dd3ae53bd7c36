#include "ui/panels/compare_panel.h"

#include <algorithm>

#include "core/vehicle/key_words.h"
#include "ui/look/figure_table.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

void fact(const char* label, const std::string& value, const Theme& theme) {
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine();
  text_right(fitted(value, ImGui::GetContentRegionAvail().x), theme.ink);
  if (ImGui::CalcTextSize(value.c_str()).x > ImGui::GetItemRectSize().x) tooltip(value, theme);
}

// How a parameter of the vehicle file is called and counted on the screen.
struct ParameterName {
  const char* key;
  const char* words;
  const char* unit;
  double per_si;
  int decimals;
};

constexpr ParameterName kNames[] = {
    {"wheel_radius_left_m", "radius L", "mm", 1e3, 3},
    {"wheel_radius_right_m", "radius R", "mm", 1e3, 3},
    {"wheelbase_m", "wheelbase", "mm", 1e3, 2},
    {"truth_mounting.x_m", "mounted x", "mm", 1e3, 1},
    {"truth_mounting.y_m", "mounted y", "mm", 1e3, 1},
    {"truth_mounting.heading_rad", "turned", "°", kDegrees.per_si, 2},
    {"truth_mounting.time_offset_s", "truth late", "ms", 1e3, 1},
};

// A parameter as the table has it.
struct ParameterRow {
  const ParameterEstimate* estimate;
  std::string words, unit, nominal, calibrated;
};

std::vector<ParameterRow> parameter_rows(const LeastSquaresCalibration& c) {
  std::vector<ParameterRow> rows;
  for (const ParameterEstimate& p : c.parameters) {
    const std::string own = parameter_words(p.name);
    ParameterName name{p.name.c_str(), own.c_str(), p.unit == "1" ? "" : p.unit.c_str(), 1.0, 4};
    if (p.unit == "m") name.unit = "mm", name.per_si = 1e3, name.decimals = 3;
    if (p.unit == "rad") name.unit = "°", name.per_si = kDegrees.per_si, name.decimals = 3;
    for (const ParameterName& n : kNames)
      if (p.name == n.key) name = n;
    const Unit bare{"", name.per_si, name.decimals, 0.0};
    rows.push_back({&p, name.words, name.unit, shown(p.nominal, bare),
                    p.determined ? shown_with_error(p.value, p.stderr_value, bare, name.decimals) : "unknown"});
  }
  return rows;
}

// Where the two numbers do not fit beside their name, the nominal one stands below the calibrated one.
void parameter_table(const LeastSquaresCalibration& c, const Theme& theme) {
  const std::vector<ParameterRow> rows = parameter_rows(c);
  const auto width_of = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  float name = 0.0f, unit = 0.0f, nominal = width_of("nominal"), calibrated = width_of("calibrated");
  for (const ParameterRow& r : rows) {
    name = std::max(name, width_of(r.words));
    unit = std::max(unit, width_of(r.unit));
    nominal = std::max(nominal, width_of(r.nominal));
    calibrated = std::max(calibrated, width_of(r.calibrated));
  }
  const float gaps = 6.0f * ImGui::GetStyle().CellPadding.x + theme.px(4);
  const bool wide = name + unit + nominal + calibrated + gaps < ImGui::GetContentRegionAvail().x;
  const std::vector<float> weights =
      wide ? std::vector<float>{0.88f, 0.28f, 0.62f, 1.3f} : std::vector<float>{0.88f, 0.28f, 1.3f};
  if (!begin_figures("parameters", weights, ImGuiTableFlags_BordersInnerH)) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  if (wide) {
    text_right("nominal", theme.muted);
    ImGui::TableNextColumn();
  }
  text_right("calibrated", wide ? theme.muted : theme.ink);
  if (!wide) text_right("nominal", theme.muted);
  for (const ParameterRow& r : rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    figure_label(r.words, theme.ink);
    tooltip(r.estimate->name, theme);
    ImGui::TableNextColumn();
    figure_label(r.unit, theme.muted);
    ImGui::TableNextColumn();
    if (wide) {
      text_right(r.nominal, theme.muted);
      ImGui::TableNextColumn();
    }
    text_right(r.calibrated, r.estimate->determined ? theme.ink : theme.muted);
    if (!r.estimate->determined) tooltip("The recording holds no information on it; the nominal value stays.", theme);
    if (!wide) text_right(r.nominal, theme.muted);
  }
  end_figures();
}

}  // namespace

Actions compare_panel(const Compare& c, bool& ask_for_file, const Theme& theme) {
  Actions actions;
  const float width = ImGui::GetContentRegionAvail().x;
  const float half = 0.5f * (width - ImGui::GetStyle().ItemSpacing.x);
  const bool busy = !c.job.empty();
  const std::string busy_words = busy ? "Busy: " + c.job + "." : "";
  heading("Recording", theme);
  if (!c.loaded) {
    note(
        "A recorded run is driven once more in the simulation by its own wheel rotation or commands. Where the two "
        "tracks part, the model of the vehicle is wrong.",
        theme);
  } else {
    ImGui::TextUnformatted(fitted(c.name, width).c_str());
    tooltip(c.name + "\n" + c.provenance, theme);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(8), theme.px(2)));
    if (c.truth_samples > 0)
      fact("drives", shown(c.travelled_m, {"m", 1.0, 1, 0.0}) + " in " + clock(c.duration_s), theme);
    else
      fact("lasts", clock(c.duration_s), theme);
    fact("driven by", c.inputs, theme);
    fact("truth", c.truth_samples > 0 ? std::to_string(c.truth_samples) + " poses" : "none", theme);
    fact("vehicle", c.vehicle_name, theme);
    fact("mass assumed", shown(c.mass_kg, kKilograms), theme);
    tooltip("The simulation's vehicle has this mass. It matters where wheels slip, and not to dead reckoning.", theme);
    ImGui::PopStyleVar();
  }
  ImGui::Dummy({1, theme.px(2)});
  ButtonLook open;
  open.primary = !c.loaded;
  open.tip =
      "Open a recording: a CSV file with the columns that the documentation lists, or one of another format (Ctrl+O)";
  if (text_button(c.loaded ? "Open…" : "Open a recording…", theme, open, c.loaded ? half : width)) ask_for_file = true;
  if (c.loaded) ImGui::SameLine();
  ButtonLook record;
  record.enabled = !busy;
  record.why_disabled = busy_words;
  record.tip =
      "Drive the scenario of Drive to its end and take what its encoders and the outside measurement recorded.";
  if (text_button(c.loaded ? "Simulate one" : "Record a simulated run", theme, record, c.loaded ? half : width))
    actions.push_back(RecordSimulatedRun{});

  if (!c.loaded)
    for (const std::string& path : c.example_files) {
      ButtonLook example;
      example.tip = path;
      if (text_button(("Example: " + words_of_file(path)).c_str(), theme, example, width))
        actions.push_back(OpenFile{path});
    }

  if (c.loaded) {
    heading("Replay with the vehicle", theme);
    if (const auto choice =
            segmented("vehicle", {"nominal", "calibrated"}, int(c.vehicle), theme, width, c.calibrated ? 2 : 1)) {
      actions.push_back(ReplayWith{ReplayVehicle(*choice)});
    }
    tooltip(
        c.calibrated ? "Which vehicle file the replay drives." : "Calibrate first: there is no calibrated vehicle yet.",
        theme);
  }
  if (c.loaded && !c.calibrated) {
    ButtonLook calibrate;
    calibrate.primary = !c.calibrated && c.can_calibrate && !busy;
    calibrate.enabled = c.can_calibrate && !busy;
    calibrate.tip =
        "Least squares over the whole recording: wheel radii, wheelbase and where the truth is mounted, each with its "
        "uncertainty.";
    calibrate.why_disabled = busy ? busy_words : c.why_not;
    if (text_button("Calibrate from this recording", theme, calibrate, width))
      actions.push_back(CalibrateFromRecording{});
  }
  if (busy) {
    ImGui::Dummy({1, theme.px(4)});
    note(c.job, theme);
    if (job_progress(c.share_done, theme)) actions.push_back(CancelJob{});
  }
  if (c.calibration) {
    heading("Calibration", theme);
    parameter_table(*c.calibration, theme);
    for (const std::string& words : c.calibration->cannot_tell) note(words, theme);
    for (const std::string& words : c.calibration->warnings) note(words, theme);
  }
  return actions;
}

}  // namespace odolab::ui
