// The recording, and which vehicle replays it.
#pragma once

#include "ui/actions.h"
#include "ui/compare.h"
#include "ui/look/theme.h"

namespace odolab::ui {

// `ask_for_file` is set where a person wants to open a recording.
Actions compare_panel(const Compare& compare, bool& ask_for_file, const Theme& theme);

}  // namespace odolab::ui
