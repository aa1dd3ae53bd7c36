// How a vehicle of any kind looks on the floor, from its shape and posture alone.
#pragma once

#include "ui/floor/camera.h"
#include "ui/floor/scene.h"

namespace odolab::ui {

void draw_vehicle(ImDrawList& draw, const Camera& camera, const VehicleGlyph& vehicle, const Theme& theme);

// How far its parts reach from its pose, in metres, rounded up to a tenth.
double reach_of(const VehicleGlyph& vehicle);

}  // namespace odolab::ui
