// Asks for the path of a file: a field, and the files used last.
#pragma once

#include <string>
#include <vector>

#include "ui/look/theme.h"

namespace odolab::ui {

struct PathDialog {
  char path[1024] = "";
  bool was_open = false;
};

// Returns the path once a person has confirmed it, and closes. `proposals` are offered below the field.
std::string path_dialog(const char* title, const char* button, bool& open, PathDialog& state,
                        const std::vector<std::string>& proposals, const Theme& theme);

}  // namespace odolab::ui
