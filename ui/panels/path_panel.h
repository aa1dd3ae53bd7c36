// The path, how fast it is driven, the sensors and the run itself.
#pragma once

#include "ui/actions.h"
#include "ui/look/theme.h"

namespace odolab::ui {

Actions path_panel(Scenario& draft, bool& editing, const Theme& theme);

}  // namespace odolab::ui
