// How the things on the floor look. Nothing here reacts to a person.
#pragma once

#include <optional>

#include "ui/floor/camera.h"
#include "ui/floor/scene.h"

namespace odolab::ui {

void draw_grid(ImDrawList& draw, const Camera& camera, const Theme& theme);
// The origin's axes; drawn after what lies there, so that they are seen on it.
void draw_origin(ImDrawList& draw, const Camera& camera, const Theme& theme);
void draw_scale_bar(ImDrawList& draw, const Camera& camera, const Theme& theme);
void draw_bump(ImDrawList& draw, const Camera& camera, const Bump& bump, bool selected, const Theme& theme);
void draw_slip_zone(ImDrawList& draw, const Camera& camera, const SlipZone& zone, bool selected, const Theme& theme);
void draw_tilt(ImDrawList& draw, const Camera& camera, const Floor& floor, const Theme& theme);
void draw_planned(ImDrawList& draw, const Camera& camera, const std::vector<Vec2>& path, const Theme& theme);
// The stroke of a kind of track, for legends as well.
void draw_stroke(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 colour, Dash dash, const Theme& theme);
// `exaggeration` multiplies the deviation from the line's reference, where it has one.
void draw_track(ImDrawList& draw, const Camera& camera, const TrackLine& line, double exaggeration, const Theme& theme);
void draw_arrow(ImDrawList& draw, ImVec2 from, ImVec2 to, ImU32 colour, float width, float head);

// The pose whose deviation from `reference` is `factor` times that of `deviating`.
Pose exaggerated(const Pose& reference, const Pose& deviating, double factor);

// Two points on the cable's ends.
std::pair<Vec2, Vec2> ends_of(const Bump& bump);

}  // namespace odolab::ui
