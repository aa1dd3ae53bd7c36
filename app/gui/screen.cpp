#include "app/gui/screen.h"

#include <algorithm>
#include <utility>

#include "app/gui/diagnosis_view.h"
#include "app/gui/dialogs.h"
#include "app/gui/panes.h"
#include "app/gui/views.h"
#include "ui/look/widgets.h"
#include "ui/panels/calibration_result_panel.h"
#include "ui/panels/compare_panel.h"
#include "ui/panels/diagnosis_findings_panel.h"
#include "ui/panels/diagnosis_runs_panel.h"
#include "ui/panels/diagnosis_time_panel.h"
#include "ui/panels/error_panel.h"
#include "ui/panels/guide_notes_panel.h"
#include "ui/panels/guide_panel.h"
#include "ui/panels/path_panel.h"
#include "ui/panels/run_panel.h"
#include "ui/panels/vehicle_panel.h"

namespace odolab {

namespace {

using ui::Actions;
using ui::append;
using ui::Theme;

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
      if (session.guide().shown()) {
        Actions actions = ui::guide_page(guide_of(session), state.guide, theme);
        if (std::exchange(state.guide.ask_for_file, false)) state.choices.show_open = true;
        return actions;
      }
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
      state.calibrate.keep_things = true;  // what lies on its floor belongs to its experiment
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
    const bool left_wraps = on_page || session.mode() == ui::Mode::learn;
    begin_pane(left_names[int(session.mode())], l.left_low, l.left_size, true, true, theme.panel, false,
               left_wraps ? 0.0f : theme.px(kLeftNeeds));
    append(actions, left_pane(session, state, theme));
    ImGui::End();

    const char* right_names[] = {"right drive", "right calibrate", "right compare", "right diagnose", "right learn"};
    const bool right_wraps = on_page || session.mode() == ui::Mode::diagnose;
    begin_pane(right_names[int(session.mode())], l.right_low, l.right_size, true, true, theme.panel, false,
               right_wraps ? 0.0f : theme.px(kRightNeeds));
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
