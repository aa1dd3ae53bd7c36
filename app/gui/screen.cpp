#include "app/gui/screen.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "app/gui/diagnosis_view.h"
#include "app/gui/views.h"
#include "core/io/import/imported_recording.h"
#include "ui/look/widgets.h"
#include "ui/panels/calibration_result_panel.h"
#include "ui/panels/compare_panel.h"
#include "ui/panels/diagnosis_findings_panel.h"
#include "ui/panels/diagnosis_runs_panel.h"
#include "ui/panels/diagnosis_time_panel.h"
#include "ui/panels/error_panel.h"
#include "ui/panels/guide_notes_panel.h"
#include "ui/panels/guide_panel.h"
#include "ui/panels/keys_panel.h"
#include "ui/panels/path_panel.h"
#include "ui/panels/run_panel.h"
#include "ui/panels/vehicle_panel.h"

namespace odolab {

namespace {

using ui::Actions;
using ui::append;
using ui::Theme;

constexpr ImGuiWindowFlags kPane = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                   ImGuiWindowFlags_NoNavFocus;

// Of the width, for both panes beside the middle, a floor or a guide's page.
constexpr float kMostAside = 0.68f, kMostBesidePage = 0.58f;
constexpr float kLeastMiddle = 250.0f, kLeastBottom = 130.0f;  // heights at scale 1

// Where the panes are, in pixels.
struct Layout {
  ImVec2 top_size, left_low, left_size, centre_low, centre_size, right_low, right_size, bottom_low, bottom_size;
  bool has_bottom = true;
};

Layout lay_out(const ScreenState& state, ImVec2 screen, bool has_bottom, bool on_page, const Theme& theme) {
  Layout l;
  l.has_bottom = has_bottom;
  const float top = state.choices.hide_interface ? 0.0f : theme.px(40);
  const float bottom = has_bottom && !state.choices.hide_interface
                           ? std::min({theme.px(float(state.bottom_height)), 0.6f * screen.y,
                                       std::max(theme.px(kLeastBottom), screen.y - top - theme.px(kLeastMiddle))})
                           : 0.0f;
  float left = state.choices.hide_interface ? 0.0f : theme.px(float(state.left_width));
  float right = state.choices.hide_interface ? 0.0f : theme.px(float(state.right_width));
  const float too_wide =
      (left + right) / ((on_page ? kMostBesidePage : kMostAside) * screen.x);  // the middle is what people look at
  if (too_wide > 1.0f) {
    left = std::round(left / too_wide);
    right = std::round(right / too_wide);
  }
  const float begin = top, height = std::max(40.0f, screen.y - begin - bottom);
  l.top_size = {screen.x, top};
  l.left_low = {0, begin};
  l.left_size = {left, height};
  l.centre_low = {left, begin};
  l.centre_size = {screen.x - left - right, height};
  l.right_low = {screen.x - right, begin};
  l.right_size = {right, height};
  l.bottom_low = {0, begin + height};
  l.bottom_size = {screen.x, bottom};
  return l;
}

// Opens a pane, `above` the others where it lies over one; end with ImGui::End().
void begin_pane(const char* name, ImVec2 low, ImVec2 size, bool padded, bool scrolls, ImU32 background,
                bool above = false) {
  ImGui::SetNextWindowPos(low);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, background);
  if (!padded) ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGuiWindowFlags flags = kPane;
  if (scrolls) flags &= ~ImGuiWindowFlags_NoScrollbar;
  if (above) flags = (flags & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::Begin(name, nullptr, flags);
  ImGui::PopStyleVar(padded ? 1 : 2);
  ImGui::PopStyleColor();
}

// An edge between panes that is dragged; `size` is at scale 1 and grows with `grows_with` times the mouse's way.
void splitter(const char* id, ImVec2 low, ImVec2 size, bool vertical, double& value, double grows_with, double least,
              double most, const Theme& theme) {
  const float grab = theme.px(6);
  const ImVec2 at = vertical ? ImVec2(low.x - 0.5f * grab, low.y) : ImVec2(low.x, low.y - 0.5f * grab);
  const ImVec2 extent = vertical ? ImVec2(grab, size.y) : ImVec2(size.x, grab);
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(extent);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin(id, nullptr,
               (kPane & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("##grip", extent);
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (lit) ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  if (ImGui::IsItemActive()) {
    const ImVec2 by = ImGui::GetIO().MouseDelta;
    value = std::clamp(value + grows_with * (vertical ? by.x : by.y) / theme.scale, least, most);
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float line = lit ? theme.px(3) : 1.0f;
  if (vertical)
    draw.AddRectFilled({std::round(low.x - 0.5f * line), low.y},
                       {std::round(low.x - 0.5f * line) + line, low.y + size.y}, lit ? theme.muted : theme.line);
  else
    draw.AddRectFilled({low.x, std::round(low.y - 0.5f * line)},
                       {low.x + size.x, std::round(low.y - 0.5f * line) + line}, lit ? theme.muted : theme.line);
  ImGui::End();
}

std::string diagnosis_title(const Session& session) {
  const std::size_t runs = session.diagnosis().runs().size();
  if (runs == 0) return "no recordings yet";
  const std::optional<Vehicle>& vehicle = session.diagnosis().vehicle();
  return std::to_string(runs) + (runs == 1 ? " run" : " runs") + (vehicle ? " of " + vehicle->name : "");
}

// The lesson's step is a benchmark: clouds instead of a floor.
bool learns_by_squares(const Session& session) {
  return session.mode() == ui::Mode::learn && session.lesson().is_open() && session.run().scenario().benchmark;
}

// Below the middle stands something, or will as soon as it plays.
bool has_lower_plots(const Session& session) {
  switch (session.mode()) {
    case ui::Mode::calibrate:
      return false;
    case ui::Mode::compare:
      return session.comparison().loaded();
    case ui::Mode::diagnose:
      return !session.diagnosis().runs().empty();
    case ui::Mode::learn:
      return session.lesson().is_open() && !learns_by_squares(session);
    case ui::Mode::drive:
      return true;
  }
  return true;
}

ui::LessonView lesson_of(const Session& session) {
  ui::LessonView view = session.lesson().view(session.jobs());
  view.benchmark = learns_by_squares(session);
  const auto& experiments = session.bench().experiments();
  view.can_drive_squares = experiments.empty();
  view.can_apply = experiments.size() == 1 && experiments.front().calibration;
  return view;
}

ui::GuideView guide_of(const Session& session) { return session.guide().view(session.jobs()); }

Actions left_pane(const Session& session, ScreenState& state, const Theme& theme) {
  Actions actions;
  switch (session.mode()) {
    case ui::Mode::drive: {
      append(actions, ui::vehicle_panel(state.draft, state.editing, theme));
      append(actions, ui::path_panel(state.draft, state.editing, theme));
      const Vec2 place = state.drive_floor.camera.centre;
      append(actions, ui::floor_panel(session.run().scenario().floor, state.drive_floor.selected, state.floor_panel,
                                      place, theme));
      append(actions, ui::run_panel(state.draft, state.editing, theme));
      break;
    }
    case ui::Mode::calibrate:
      if (const auto choice = ui::segmented("calibrate", {"Bench", "Guides"}, session.guide().shown() ? 1 : 0, theme,
                                            ImGui::GetContentRegionAvail().x))
        actions.push_back(ui::ShowGuides{*choice == 1});
      append(actions, session.guide().shown() ? ui::guide_panel(guide_of(session), theme)
                                              : ui::calibrate_panel(bench_of(session), state.calibrate, theme));
      break;
    case ui::Mode::compare:
      append(actions, ui::compare_panel(compare_of(session, state.example_files), state.choices.show_open, theme));
      break;
    case ui::Mode::diagnose:
      append(actions, ui::diagnosis_runs_panel(session.diagnosis().view(session.jobs()), state.diagnosis,
                                               session.run().scenario().vehicle.name, state.choices.show_open, theme));
      break;
    case ui::Mode::learn:
      append(actions, ui::lesson_panel(lesson_of(session), state.lesson, theme));
      break;
  }
  return actions;
}

Actions right_pane(const Session& session, ScreenState& state, const SimulationState& shown, const Theme& theme) {
  Actions actions;
  switch (session.mode()) {
    case ui::Mode::drive:
      append(actions, ui::welcome_card(state.welcome, theme));
      append(actions, ui::readout_panel(readout_of(session, shown, theme), state.estimators, theme));
      break;
    case ui::Mode::calibrate:
      if (session.guide().shown())
        append(actions, ui::guide_notes_panel(guide_of(session), theme));
      else
        ui::calibration_result_panel(bench_of(session), theme);
      break;
    case ui::Mode::compare:
      ui::error_panel(compare_of(session, state.example_files), error_now(session), theme);
      break;
    case ui::Mode::diagnose:
      append(actions, ui::diagnosis_findings_panel(session.diagnosis().view(session.jobs()), state.diagnosis, theme));
      break;
    case ui::Mode::learn:
      if (learns_by_squares(session))
        ui::calibration_result_panel(bench_of(session), theme);
      else
        append(actions, ui::readout_panel(readout_of(session, shown, theme), state.estimators, theme));
      break;
  }
  return actions;
}

Actions diagnosis_centre(const Session& session, ScreenState& state, const Theme& theme) {
  const ui::DiagnosisView view = session.diagnosis().view(session.jobs());
  if (state.diagnosis.answers_seen != view.answers) {  // a new answer: look where it is worst
    state.diagnosis.answers_seen = view.answers;
    if (view.diagnosis) state.diagnosis.run = view.worst_run;
    state.diagnosis.response = 0;
    state.diagnosis.brush.clear();
    state.diagnosis.lit.reset();
    state.diagnosis.time_view.fitted = state.diagnosis.response_view.fitted = state.diagnosis.fit_floor = true;
  }
  if (std::exchange(state.diagnosis.runs_seen, view.runs.size()) != view.runs.size()) state.diagnosis.fit_floor = true;
  state.diagnosis_floor.fit_next = std::exchange(state.diagnosis.fit_floor, false) || state.diagnosis_floor.fit_next;
  if (view.runs.empty()) return ui::diagnosis_welcome(view, state.diagnosis, state.choices.show_open, theme);
  Actions actions = ui::floor_view(diagnosis_scene(view, state.diagnosis, theme), state.diagnosis_floor, theme);
  if (const auto corners = std::exchange(state.diagnosis_floor.brushed, std::nullopt)) {
    const ui::DiagnosedRun& run = view.runs[std::min(state.diagnosis.run, view.runs.size() - 1)];
    const ui::Trail* trail = run.mismatch_trail ? run.mismatch_trail : run.way;
    state.diagnosis.brush = trail ? trail->inside(corners->first, corners->second) : std::vector<ui::Stretch>{};
    state.diagnosis.lit.reset();
  }
  return actions;
}

Actions centre_pane(const Session& session, ScreenState& state, const SimulationState& shown, const Theme& theme) {
  switch (session.mode()) {
    case ui::Mode::drive:
      return ui::floor_view(drive_scene(session, shown, theme, state.estimators.shown), state.drive_floor, theme);
    case ui::Mode::calibrate:
      if (session.guide().shown()) return ui::guide_page(guide_of(session), state.guide, theme);
      ui::cluster_panel(bench_of(session), state.clusters, theme);
      return {};
    case ui::Mode::compare:
      return ui::floor_view(compare_scene(session, theme), state.compare_floor, theme);
    case ui::Mode::diagnose:
      return diagnosis_centre(session, state, theme);
    case ui::Mode::learn:
      if (!learns_by_squares(session))
        return ui::floor_view(drive_scene(session, shown, theme, state.estimators.shown), state.drive_floor, theme);
      ui::cluster_panel(bench_of(session), state.clusters, theme);
      return {};
  }
  return {};
}

std::vector<std::string> first_of(const std::vector<std::string>& all, std::size_t most) {
  return {all.begin(), all.begin() + long(std::min(most, all.size()))};
}

Actions dialogs(const Session& session, ScreenState& state, const Theme& theme) {
  Actions actions;
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

}  // namespace

bool has_curves(const Session& session) {
  if (session.mode() == ui::Mode::compare) return session.comparison().shown() != nullptr;
  return session.mode() == ui::Mode::drive || (session.mode() == ui::Mode::learn && !learns_by_squares(session));
}

Actions draw_screen(const Session& session, ScreenState& state, const Theme& theme) {
  Actions actions;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (state.loads_seen != session.loads()) {
    state.loads_seen = session.loads();
    state.drive_floor.fit_next = state.compare_floor.fit_next = true;
    state.drive_transport.view.fitted = state.compare_transport.view.fitted = true;
    state.editing = false;
    if (session.mode() == ui::Mode::learn && session.lesson().is_open())
      state.drive_transport.show_heading = session.lesson().step().plot_heading;
    if (const std::optional<Benchmark>& asked = session.run().scenario().benchmark) {
      state.calibrate.runs_each_way = asked->runs_each_way;
      state.calibrate.keep_things = !asked->extended;  // what lies on its floor belongs to its experiment
    }
  }
  if (state.choices.fit_view) {
    state.choices.fit_view = false;
    state.drive_floor.fit_next = state.compare_floor.fit_next = state.diagnosis_floor.fit_next = true;
    state.diagnosis.time_view.fitted = state.diagnosis.response_view.fitted = true;
    state.clusters.view.fitted = true;
  }
  // A field that is being edited keeps its draft; anything else shows the scenario as it is.
  if (!state.editing || !ImGui::IsAnyItemActive()) {
    state.draft = session.run().scenario();
    state.editing = false;
  }
  const SimulationState shown = session.run().shown();
  const bool has_bottom = has_lower_plots(session);
  const bool on_page = session.mode() == ui::Mode::calibrate && session.guide().shown();
  const Layout l = lay_out(state, screen, has_bottom, on_page, theme);

  const bool on_plots = !on_page && (session.mode() == ui::Mode::calibrate || learns_by_squares(session));
  const float message_height = ui::message_bar_height(session.messages(), l.centre_size.x, theme);
  state.guide.covered_below = on_page ? message_height : 0.0f;
  ImVec2 centre_size = l.centre_size;
  if (on_plots) centre_size.y -= message_height;
  begin_pane("centre", l.centre_low, centre_size, false, false, theme.panel);
  append(actions, centre_pane(session, state, shown, theme));
  ImGui::End();

  // Over the floor and below its tools: a message moves nothing of what a person is looking at. A guide's page above
  // its way on, and a plot, become shorter by it instead: they have numbers along their lower edge.
  if (message_height > 0.0f) {
    const float tools = ImGui::GetFrameHeight() + theme.px(11), bottom = l.centre_low.y + l.centre_size.y;
    const float y = on_page    ? bottom - message_height - tools - theme.px(11)
                    : on_plots ? bottom - message_height
                               : l.centre_low.y + tools;
    begin_pane("messages", {l.centre_low.x, y}, {l.centre_size.x, message_height}, false, false, theme.panel, true);
    append(actions, ui::message_bar(session.messages(), theme));
    ImGui::End();
  }
  if (!state.choices.hide_interface) {
    begin_pane("top", {0, 0}, l.top_size, false, false, theme.panel);
    ui::TopBar bar;
    bar.mode = session.mode();
    bar.title = session.mode() == ui::Mode::compare
                    ? (session.comparison().loaded() ? session.comparison().recording().name : "no recording yet")
                : session.mode() == ui::Mode::diagnose ? diagnosis_title(session)
                                                       : session.title();
    bar.playing = session.playing();
    bar.can_undo = session.can_undo();
    bar.can_redo = session.can_redo();
    bar.has_curves = has_curves(session);
    bar.recent_files = state.recent_files;
    bar.example_files = state.example_files;
    append(actions, ui::top_bar(bar, state.choices, theme));
    ImGui::GetWindowDrawList()->AddLine({0, l.top_size.y - 1}, {screen.x, l.top_size.y - 1}, theme.line);
    ImGui::End();

    const char* left_names[] = {"left drive", "left calibrate", "left compare", "left diagnose", "left learn"};
    begin_pane(left_names[int(session.mode())], l.left_low, l.left_size, true, true, theme.panel);
    append(actions, left_pane(session, state, theme));
    ImGui::End();

    const char* right_names[] = {"right drive", "right calibrate", "right compare", "right diagnose", "right learn"};
    begin_pane(right_names[int(session.mode())], l.right_low, l.right_size, true, true, theme.panel);
    append(actions, right_pane(session, state, shown, theme));
    ImGui::End();

    if (has_bottom) {
      begin_pane("bottom", l.bottom_low, l.bottom_size, true, false, theme.panel);
      if (session.mode() == ui::Mode::diagnose)
        append(actions, ui::diagnosis_time_panel(session.diagnosis().view(session.jobs()), state.diagnosis, theme));
      else if (session.mode() != ui::Mode::compare)
        append(actions, ui::transport_bar(drive_transport(session, theme, state.estimators.shown),
                                          state.drive_transport, theme));
      else
        append(actions, ui::transport_bar(compare_transport(session, theme), state.compare_transport, theme));
      ImGui::End();
      splitter("split bottom", l.bottom_low, l.bottom_size, false, state.bottom_height, -1.0, 110.0, 600.0, theme);
    }
    splitter("split left", {l.left_size.x, l.left_low.y}, l.left_size, true, state.left_width, 1.0, 200.0, 600.0,
             theme);
    splitter("split right", l.right_low, l.right_size, true, state.right_width, -1.0, 200.0, 600.0, theme);
  }
  append(actions, dialogs(session, state, theme));
  return actions;
}

}  // namespace odolab
