// The floor: friction, tilt, roughness, and the list of what lies on it. Takes effect while the vehicle drives.
#pragma once

#include <optional>

#include "ui/actions.h"
#include "ui/floor/editing.h"
#include "ui/look/theme.h"

namespace odolab::ui {

// `place` is where a new thing is put down, e.g. the middle of the view.
Actions floor_panel(const Floor& floor, std::optional<FloorThing>& selected, Vec2 place, const Theme& theme);

}  // namespace odolab::ui
