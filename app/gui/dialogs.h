// What asks for a path: opening a file, saving a scenario, a recording, the curves; and the list of keys.
#pragma once

#include "app/gui/screen.h"
#include "ui/look/theme.h"

namespace odolab {

// Draws those that are open, over everything.
ui::Actions dialogs(const Session& session, ScreenState& state, const ui::Theme& theme);

}  // namespace odolab
