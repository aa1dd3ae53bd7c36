// What the window remembers from one start to the next.
#pragma once

#include <string>
#include <vector>

namespace odolab {

struct Settings {
  bool dark = false;
  double scale = 0.0;  // 0: as the monitor says
  int width = 1280, height = 720;
  double left_width = 316.0, right_width = 292.0, bottom_height = 186.0;  // panes, at scale 1
  bool welcome_seen = false;
  std::vector<std::string> recent_files;  // the newest first
};

// $XDG_CONFIG_HOME/odolab/window, else ~/.config/odolab/window; empty where neither variable is set.
std::string settings_path();

// $XDG_DATA_HOME/odolab, else ~/.local/share/odolab: what people have entered in guides, and edited. Empty where
// neither variable is set.
std::string data_folder();

// Defaults where there is no such file; lines that are not understood are skipped.
Settings read_settings(const std::string& path);
// Says nothing where it cannot be written: a window that forgets is no reason to stop.
void write_settings(const std::string& path, const Settings& settings);

}  // namespace odolab
