// The row of buttons above the floor: what the mouse does, what is in sight, what is drawn.
#pragma once

#include "ui/panels/floor_view.h"

namespace odolab::ui {

void floor_toolbar(FloorViewState& state, const FloorScene& scene, const Theme& theme);

}  // namespace odolab::ui
