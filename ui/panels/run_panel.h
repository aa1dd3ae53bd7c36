// The sensors, the time step and the seed, folded away at first.
#pragma once

#include "ui/actions.h"
#include "ui/look/theme.h"

namespace odolab::ui {

Actions run_panel(Scenario& draft, bool& editing, const Theme& theme);

}  // namespace odolab::ui
