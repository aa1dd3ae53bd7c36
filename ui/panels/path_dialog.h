// Asks for the path of a file: a field, what lies in the folder typed so far, and the files used last.
#pragma once

#include <string>
#include <vector>

#include "ui/look/theme.h"

namespace odolab::ui {

// A file or a folder that can be clicked.
struct PathEntry {
  std::string name;  // as it is shown
  std::string path;  // as it would be typed, a folder with a slash at its end
  bool is_folder = false;
};

struct PathDialog {
  char path[1024] = "";
  bool was_open = false;
  bool to_end = false;  // the cursor goes behind the path, to type on; else all of it is selected, to type anew
  std::string problem;  // why it is still open, in words
};

// Returns the path once a person has confirmed it, and closes; Escape closes it without one. Nothing behind it reacts.
// `entries` are listed below the field, `proposals` below them.
std::string path_dialog(const char* title, const char* button, bool& open, PathDialog& state,
                        const std::vector<PathEntry>& entries, const std::vector<std::string>& proposals,
                        const Theme& theme);

}  // namespace odolab::ui
