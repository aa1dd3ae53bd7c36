// Which thing on the floor lies under the mouse, and what a drag does to it.
#pragma once

#include <optional>

#include "core/scenario/floor.h"
#include "ui/floor/camera.h"

namespace odolab::ui {

enum class ThingKind { bump, slip_zone };

struct FloorThing {
  ThingKind kind = ThingKind::bump;
  std::size_t index = 0;

  bool operator==(const FloorThing&) const = default;
};

// The whole of it, or the handle that a selected one shows.
enum class Grip { body, first_end, second_end, size };

struct Grasp {
  FloorThing thing;
  Grip grip = Grip::body;
};

bool exists(const Floor& floor, const FloorThing& thing);

// What a press at a place on the screen takes hold of; handles belong to the selected thing alone. `reach_px` is how
// near counts.
std::optional<Grasp> grasp_at(const Floor& floor, const Camera& camera, ImVec2 at, float reach_px,
                              const std::optional<FloorThing>& selected);

// The floor after the grasped thing was pulled from one place to another.
Floor dragged(const Floor& floor, const Grasp& grasp, Vec2 from, Vec2 to);
Floor removed(const Floor& floor, const FloorThing& thing);

// Things as a person first puts them down.
Bump new_bump(Vec2 centre);
SlipZone new_slip_disc(Vec2 centre);
SlipZone new_slip_rectangle(Vec2 centre);

}  // namespace odolab::ui
