// The path and how fast it is driven.
#pragma once

#include "ui/actions.h"
#include "ui/look/theme.h"

namespace odolab::ui {

Actions path_panel(Scenario& draft, bool& editing, const Theme& theme);

}  // namespace odolab::ui
