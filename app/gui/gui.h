// The desktop app.
#pragma once

#include <string>
#include <vector>

namespace odolab {

struct GuiOptions {
  std::vector<std::string> files;  // scenarios, vehicles or recordings to open
  std::string screenshot_path;     // draws `frames` pictures without a person, writes the last one, and ends
  int frames = 60;
  int width = 1280, height = 720;  // of the window in pixels of a 96 dpi screen; of the picture in its own pixels
  double scale = 0.0;              // 0: as the monitor says
  std::string mode;                // "drive", "calibrate", "compare", "diagnose", "learn"; empty: as the files ask for
  int mystery = -1;                // 0 or more: the mystery robot of this number, in Diagnose
  bool dark = false;               // for pictures; a window remembers what was chosen
};

// Runs until the window is closed. 0: done; 2: bad input, or no window could be opened; then one line on standard
// error.
int run_gui(const GuiOptions& options);

}  // namespace odolab
