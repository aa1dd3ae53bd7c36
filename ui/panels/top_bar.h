// The menu with its keys, and the modes: what this window is for, one word each.
#pragma once

#include <string>
#include <vector>

#include "ui/actions.h"
#include "ui/look/theme.h"

namespace odolab::ui {

// What the menu shows and what it switches by itself.
struct TopBar {
  Mode mode = Mode::drive;
  std::string title;  // of what is loaded
  bool playing = false;
  bool can_undo = false, can_redo = false;
  bool has_curves = false;  // there is a plot over time
  std::vector<std::string> recent_files;
  std::vector<std::string> example_files;
};

// Switches of the window itself; the caller keeps them.
struct WindowChoices {
  bool dark = false;
  double scale = 0.0;  // 0: as the monitor says
  bool show_keys = false;
  bool hide_interface = false;
  bool show_open = false;
  bool show_save_scenario = false;
  bool show_save_recording = false;
  bool show_save_curves = false;
  bool fit_view = false;      // set to fit the floor at the next chance
  std::string menu_at_press;  // which was open when the mouse was pressed last
};

Actions top_bar(const TopBar& bar, WindowChoices& choices, const Theme& theme);

}  // namespace odolab::ui
