// What each key does.
#pragma once

#include "app/gui/screen.h"
#include "app/gui/session.h"
#include "app/gui/window.h"

namespace odolab {

// Switches of the window are set in the state at once; all else is returned.
ui::Actions actions_of(const KeyPress& press, const Session& session, ScreenState& state);

// The wheel command of a person who holds keys down; for a HandPath alone.
ui::DriveByHand hand_command(const Window& window, const Scenario& scenario);

}  // namespace odolab
