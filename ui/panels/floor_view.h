// The floor in the middle of the window: pan, zoom, follow, and things that are put down, dragged and taken away.
#pragma once

#include "ui/actions.h"
#include "ui/floor/camera.h"
#include "ui/floor/editing.h"
#include "ui/floor/scene.h"

namespace odolab::ui {

enum class FloorTool { pointer, bump, slip_disc, slip_rectangle, brush };

struct FloorViewState {
  Camera camera;
  bool fit_next = true;  // fits everything into sight at the next chance
  bool touched = false;  // a person has panned or zoomed: the view stays as it is
  bool follow = false;
  bool show_lens = true;
  bool show_grid = true;
  bool show_planned = true;
  bool show_tracks = true;
  bool show_things = true;
  bool exaggerate = false;
  double exaggeration = 10.0;
  FloorTool tool = FloorTool::pointer;
  std::optional<FloorThing> selected;
  std::optional<Grasp> grasp;
  Vec2 grasp_from;  // where on the floor the drag was last
  bool gesture_began = false;
  bool panning = false;
  Vec2 menu_at;
  bool brushing = false;
  Vec2 brush_from;
  std::optional<std::pair<Vec2, Vec2>> brushed;  // two corners, once a person has let go; the caller takes it
};

Actions floor_view(const FloorScene& scene, FloorViewState& state, const Theme& theme);

}  // namespace odolab::ui
