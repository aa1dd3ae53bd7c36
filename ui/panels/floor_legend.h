// What the lines on the floor are: the tracks' names, and what colour a mismatch has.
#pragma once

#include "ui/panels/floor_view.h"

namespace odolab::ui {

void floor_legend(ImDrawList& draw, const FloorScene& scene, const FloorViewState& state, const Theme& theme);

}  // namespace odolab::ui
