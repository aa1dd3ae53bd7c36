// A magnifying glass over the vehicle: the gap between two poses at a stated magnification.
#pragma once

#include "ui/floor/camera.h"
#include "ui/floor/scene.h"

namespace odolab::ui {

// The round magnification (..., 0.5, 1, 2, 5, 10, ...) over `px_per_m` at which a gap takes up a good part of a lens of
// this radius, at most 1000; below 1 where the gap is larger than the lens, so that both poses are always in it.
double lens_magnification(double gap_m, double px_per_m, double lens_radius_px);

// Draws the lens in the given square. Nothing where the scene has no two poses, or where the floor
// shows their gap as large.
void draw_lens(ImDrawList& draw, ImVec2 low, ImVec2 high, const FloorScene& scene, double px_per_m, const Theme& theme);

}  // namespace odolab::ui
