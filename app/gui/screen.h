// The whole window, pane by pane: which panel stands where, and what of the session it shows.
#pragma once

#include <string>

#include "app/gui/folder_listing.h"
#include "app/gui/session.h"
#include "ui/diagnosis.h"
#include "ui/panels/calibrate_panel.h"
#include "ui/panels/cluster_panel.h"
#include "ui/panels/estimator_panel.h"
#include "ui/panels/floor_panel.h"
#include "ui/panels/floor_view.h"
#include "ui/panels/guide_page.h"
#include "ui/panels/lesson_panel.h"
#include "ui/panels/path_dialog.h"
#include "ui/panels/readout_panel.h"
#include "ui/panels/top_bar.h"
#include "ui/panels/transport_bar.h"

namespace odolab {

// What the panels remember between pictures; nothing of the domain is in it.
struct ScreenState {
  ui::WindowChoices choices;
  double left_width = 316.0, right_width = 292.0, bottom_height = 186.0;  // at scale 1
  ui::Welcome welcome;
  ui::FloorViewState drive_floor, compare_floor, diagnosis_floor;
  ui::FloorPanelState floor_panel;
  ui::EstimatorState estimators;
  ui::TransportState drive_transport, compare_transport;
  ui::CalibrateState calibrate;
  ui::ClusterState clusters;
  ui::GuidePageState guide;
  ui::LessonPanelState lesson;
  ui::DiagnosisState diagnosis;
  FolderListing folders;
  ui::PathDialog open_dialog, save_scenario_dialog, save_recording_dialog, save_curves_dialog;
  Scenario draft;  // of the parameters that a person is editing
  bool editing = false;
  int loads_seen = 0;
  std::vector<std::string> recent_files, example_files;
};

// A dialog is open: no key belongs to what lies behind it.
inline bool asks_for_path(const ScreenState& state) {
  return state.choices.show_open || state.choices.show_save_scenario || state.choices.show_save_recording ||
         state.choices.show_save_curves;
}

inline void close_dialogs(ScreenState& state) {
  state.choices.show_open = state.choices.show_save_scenario = state.choices.show_save_recording =
      state.choices.show_save_curves = false;
}

// The plot over time below the floor shows something.
bool has_curves(const Session& session);

// Draws one picture of everything and returns what a person wants done.
ui::Actions draw_screen(const Session& session, ScreenState& state, const ui::Theme& theme);

}  // namespace odolab
