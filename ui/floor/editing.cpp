#include "ui/floor/editing.h"

#include <algorithm>
#include <cmath>

#include "ui/floor/drawing.h"

namespace odolab::ui {

namespace {

float distance(ImVec2 a, ImVec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

float distance_to_segment(ImVec2 p, ImVec2 a, ImVec2 b) {
  const float dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const float u = squared > 0.0f ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0f, 1.0f) : 0.0f;
  return distance(p, {a.x + u * dx, a.y + u * dy});
}

void set_ends(Bump& bump, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  if (length(along) < 0.02) return;
  bump.centre = 0.5 * (a + b);
  bump.length_m = length(along);
  bump.direction_rad = std::atan2(along.y_m, along.x_m);
}

}  // namespace

bool exists(const Floor& floor, const FloorThing& thing) {
  return thing.index < (thing.kind == ThingKind::bump ? floor.bumps.size() : floor.slip_zones.size());
}

std::optional<Grasp> grasp_at(const Floor& floor, const Camera& camera, ImVec2 at, float reach_px,
                              const std::optional<FloorThing>& selected) {
  if (selected && exists(floor, *selected)) {
    if (selected->kind == ThingKind::bump) {
      const auto [a, b] = ends_of(floor.bumps[selected->index]);
      if (distance(at, camera.screen(a)) <= reach_px) return Grasp{*selected, Grip::first_end};
      if (distance(at, camera.screen(b)) <= reach_px) return Grasp{*selected, Grip::second_end};
    } else {
      const Shape& shape = floor.slip_zones[selected->index].shape;
      std::optional<Vec2> handle;
      if (const Disc* disc = std::get_if<Disc>(&shape)) handle = disc->centre + Vec2{disc->radius_m, 0.0};
      if (const Rectangle* r = std::get_if<Rectangle>(&shape))
        handle = r->centre + rotated({0.5 * r->width_m, 0.5 * r->height_m}, r->direction_rad);
      if (handle && distance(at, camera.screen(*handle)) <= reach_px) return Grasp{*selected, Grip::size};
    }
  }
  for (std::size_t i = floor.bumps.size(); i-- > 0;) {
    const auto [a, b] = ends_of(floor.bumps[i]);
    if (distance_to_segment(at, camera.screen(a), camera.screen(b)) <= reach_px)
      return Grasp{{ThingKind::bump, i}, Grip::body};
  }
  for (std::size_t i = floor.slip_zones.size(); i-- > 0;)
    if (contains(floor.slip_zones[i].shape, camera.floor(at))) return Grasp{{ThingKind::slip_zone, i}, Grip::body};
  return std::nullopt;
}

Floor dragged(const Floor& floor, const Grasp& grasp, Vec2 from, Vec2 to) {
  Floor result = floor;
  if (!exists(floor, grasp.thing)) return result;
  const Vec2 by = to - from;
  if (grasp.thing.kind == ThingKind::bump) {
    Bump& bump = result.bumps[grasp.thing.index];
    const auto [a, b] = ends_of(bump);
    if (grasp.grip == Grip::first_end)
      set_ends(bump, a + by, b);
    else if (grasp.grip == Grip::second_end)
      set_ends(bump, a, b + by);
    else
      bump.centre = bump.centre + by;
    return result;
  }
  SlipZone& zone = result.slip_zones[grasp.thing.index];
  if (grasp.grip != Grip::size) {
    zone.shape = moved(zone.shape, by);
    return result;
  }
  constexpr double kLeast = 0.05;
  if (Disc* disc = std::get_if<Disc>(&zone.shape)) disc->radius_m = std::max(kLeast, disc->radius_m + by.x_m);
  if (Rectangle* r = std::get_if<Rectangle>(&zone.shape)) {
    const Vec2 local = rotated(by, -r->direction_rad);
    r->width_m = std::max(kLeast, r->width_m + 2.0 * local.x_m);
    r->height_m = std::max(kLeast, r->height_m + 2.0 * local.y_m);
  }
  return result;
}

Floor removed(const Floor& floor, const FloorThing& thing) {
  Floor result = floor;
  if (!exists(floor, thing)) return result;
  if (thing.kind == ThingKind::bump)
    result.bumps.erase(result.bumps.begin() + long(thing.index));
  else
    result.slip_zones.erase(result.slip_zones.begin() + long(thing.index));
  return result;
}

Bump new_bump(Vec2 centre) {
  Bump bump;
  bump.centre = centre;
  return bump;
}

SlipZone new_slip_disc(Vec2 centre) {
  SlipZone zone;
  zone.shape = Disc{centre, 0.5};
  zone.slip = 0.1;
  return zone;
}

SlipZone new_slip_rectangle(Vec2 centre) {
  SlipZone zone;
  zone.shape = Rectangle{centre, 1.0, 0.6, 0.0};
  zone.slip = 0.1;
  return zone;
}

}  // namespace odolab::ui
