// The floor: friction, tilt, roughness, and the list of what lies on it. Takes effect while the vehicle drives.
#pragma once

#include <optional>

#include "ui/actions.h"
#include "ui/floor/editing.h"
#include "ui/look/theme.h"

namespace odolab::ui {

struct FloorPanelState {
  bool in_gesture = false;  // a field is being dragged: one step for undo
};

// `place` is where a new thing is put down, e.g. the middle of the view.
Actions floor_panel(const Floor& floor, std::optional<FloorThing>& selected, FloorPanelState& state, Vec2 place,
                    const Theme& theme);

}  // namespace odolab::ui
