// What the lines on the floor are: the tracks' names, and what colour a mismatch has.
#pragma once

#include "ui/panels/floor_view.h"

namespace odolab::ui {

// Draws it over the upper left of the view, or only measures where `draw` is null; returns the height that it covers.
float floor_legend(ImDrawList* draw, const FloorScene& scene, const FloorViewState& state, const Theme& theme);

}  // namespace odolab::ui
