#include "app/gui/dialogs.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/gui/views.h"
#include "core/io/import/imported_recording.h"
#include "ui/panels/keys_panel.h"

namespace odolab {

namespace {

std::vector<std::string> first_of(const std::vector<std::string>& all, std::size_t most) {
  return {all.begin(), all.begin() + long(std::min(most, all.size()))};
}

}  // namespace

ui::Actions dialogs(const Session& session, ScreenState& state, const ui::Theme& theme) {
  ui::Actions actions;
  ui::WindowChoices& choices = state.choices;
  ui::keys_panel(choices.show_keys, theme);
  std::vector<ui::PathEntry> entries;
  if (choices.show_open)
    entries = state.folders.of(state.open_dialog.path);
  else
    state.folders.forget();
  const std::string opened =
      expanded(ui::path_dialog("Open a scenario, a vehicle or a recording", "Open", choices.show_open,
                               state.open_dialog, entries, first_of(state.recent_files, 5), theme));
  std::error_code unknown;
  if (!opened.empty() && std::filesystem::is_directory(opened, unknown) && !is_foreign_recording(opened)) {
    const std::string folder = opened.back() == '/' ? opened : opened + "/";
    std::snprintf(state.open_dialog.path, sizeof state.open_dialog.path, "%s", folder.c_str());
    choices.show_open = state.open_dialog.to_end = true;
  } else if (!opened.empty() && !std::filesystem::exists(opened, unknown)) {
    state.open_dialog.problem = "There is no such file.";
    choices.show_open = true;
  } else if (!opened.empty()) {
    actions.push_back(ui::OpenFile{opened});
  }
  const std::string scenario = expanded(ui::path_dialog("Save the scenario", "Save", choices.show_save_scenario,
                                                        state.save_scenario_dialog, {}, {"scenario.toml"}, theme));
  if (!scenario.empty()) actions.push_back(ui::SaveScenario{scenario});
  const bool compare = session.mode() == ui::Mode::compare;
  const std::string recording = expanded(
      ui::path_dialog(compare ? "Save the recording as CSV" : "Save what the run has recorded so far as CSV", "Save",
                      choices.show_save_recording, state.save_recording_dialog, {}, {"recording.csv"}, theme));
  if (!recording.empty()) actions.push_back(ui::SaveRecording{recording});
  const std::string curves =
      expanded(ui::path_dialog("Save the curves over time as CSV, as far as they are shown", "Save",
                               choices.show_save_curves, state.save_curves_dialog, {}, {"curves.csv"}, theme));
  if (!curves.empty())
    actions.push_back(ui::SaveCurves{
        curves,
        compare ? ui::shown_curves(compare_transport(session, theme), state.compare_transport)
                : ui::shown_curves(drive_transport(session, theme, state.estimators.shown), state.drive_transport)});
  return actions;
}

}  // namespace odolab
