#include "ui/floor/vehicle_drawing.h"

#include <algorithm>
#include <cmath>

#include "ui/floor/drawing.h"
#include "ui/look/strokes.h"

namespace odolab::ui {

namespace {

// The pose of a body on the floor: all bodies go with the glyph's pose as they stand about the posture's reference.
Pose placed(const VehicleGlyph& v, int body) {
  return v.pose * between(v.posture.reference, v.posture.bodies[std::size_t(body)]);
}

std::vector<ImVec2> on_screen(const Camera& camera, const Pose& pose, const std::vector<Vec2>& outline) {
  std::vector<ImVec2> points;
  for (const Vec2 p : outline) points.push_back(camera.screen(pose * p));
  return points;
}

// Corners of a rectangle about a pose.
std::vector<Vec2> box(double half_length, double half_width) {
  return {
      {-half_length, -half_width}, {half_length, -half_width}, {half_length, half_width}, {-half_length, half_width}};
}

Pose wheel_pose(const VehicleGlyph& v, std::size_t i) {
  const WheelShape& w = v.shape->wheels[i];
  return placed(v, w.body) * Pose{w.place.x_m, w.place.y_m, w.direction_rad + v.posture.wheels[i].steered_rad};
}

// Treads seen from above: they move forward on top of the wheel and crowd at its ends.
void draw_wheel(ImDrawList& draw, const Camera& camera, const Pose& pose, const WheelShape& w, const WheelState& state,
                const Theme& theme) {
  const double half = 0.5 * w.width_m;
  const std::vector<ImVec2> tyre = on_screen(camera, pose, box(w.radius_m, half));
  draw.AddConvexPolyFilled(tyre.data(), 4, theme.ink);
  if (w.radius_m * camera.px_per_m < theme.px(9)) return;
  constexpr int kTreads = 8;
  for (int i = 0; i < kTreads; ++i) {
    const double angle = std::remainder(state.rotation_rad + 2.0 * kPi * i / kTreads, 2.0 * kPi);
    if (std::abs(angle) > 0.5 * kPi) continue;
    const double x = w.radius_m * std::sin(angle);
    draw.AddLine(camera.screen(pose * Vec2{x, -half}), camera.screen(pose * Vec2{x, half}), faded(theme.paper, 0.75f),
                 theme.px(1));
  }
}

// The upper run of a track moves forward with the vehicle, as fast again as it drives.
void draw_track_of(ImDrawList& draw, const Camera& camera, const Pose& pose, const WheelShape& w,
                   const WheelState& state, const Theme& theme) {
  const double half = 0.5 * w.width_m, end = 0.5 * w.contact_length_m + w.radius_m;
  const double cut = 0.5 * w.radius_m;
  const std::vector<ImVec2> belt = on_screen(camera, pose,
                                             {{-end + cut, -half},
                                              {end - cut, -half},
                                              {end, -0.6 * half},
                                              {end, 0.6 * half},
                                              {end - cut, half},
                                              {-end + cut, half},
                                              {-end, 0.6 * half},
                                              {-end, -0.6 * half}});
  draw.AddConvexPolyFilled(belt.data(), int(belt.size()), theme.ink);
  const double pitch = std::max(0.5 * w.radius_m, theme.px(5) / camera.px_per_m);
  const double shift = std::fmod(w.radius_m * state.rotation_rad, pitch);
  for (double x = -end + cut + shift; x < end - cut; x += pitch) {
    if (x < -end + cut) continue;
    draw.AddLine(camera.screen(pose * Vec2{x, -half}), camera.screen(pose * Vec2{x, half}), faded(theme.paper, 0.55f),
                 theme.px(1));
  }
}

// A spring between two points: straight ends and a zigzag.
void draw_spring(ImDrawList& draw, ImVec2 a, ImVec2 b, ImU32 colour, const Theme& theme) {
  const float length = std::hypot(b.x - a.x, b.y - a.y);
  if (length < theme.px(12)) {
    draw.AddLine(a, b, colour, theme.px(2));
    return;
  }
  const ImVec2 d{(b.x - a.x) / length, (b.y - a.y) / length}, across{-d.y, d.x};
  const float half = std::min(theme.px(5), 0.05f * length);
  constexpr int kTurns = 8;
  std::vector<ImVec2> points{a};
  for (int i = 0; i <= kTurns; ++i) {
    const float along = length * (0.38f + 0.24f * float(i) / kTurns);
    const float aside = i == 0 || i == kTurns ? 0.0f : (i % 2 == 0 ? half : -half);
    points.push_back({a.x + d.x * along + across.x * aside, a.y + d.y * along + across.y * aside});
  }
  points.push_back(b);
  draw.AddPolyline(points.data(), int(points.size()), colour, 0, theme.px(2));
}

// A body above others is filled below them, and its edge drawn over them.
enum class Layer { below, bodies, above };

void draw_bodies(ImDrawList& draw, const Camera& camera, const VehicleGlyph& v, Layer layer, const Theme& theme) {
  for (std::size_t i = 0; i < v.shape->bodies.size(); ++i) {
    const BodyShape& body = v.shape->bodies[i];
    if (body.outline.size() < 3 || body.see_through != (layer != Layer::bodies)) continue;
    std::vector<ImVec2> outline = on_screen(camera, placed(v, int(i)), body.outline);
    if (v.outline) {
      if (layer == Layer::below) continue;
      outline.push_back(outline.front());
      dashed_line(draw, outline, v.colour, theme.px(2), theme.px(6), theme.px(4));
      continue;
    }
    if (layer != Layer::above) draw.AddConvexPolyFilled(outline.data(), int(outline.size()), faded(theme.panel, 0.92f));
    if (layer != Layer::below)
      draw.AddPolyline(outline.data(), int(outline.size()), v.colour, ImDrawFlags_Closed, theme.px(1.8f));
  }
}

void draw_rods(ImDrawList& draw, const Camera& camera, const VehicleGlyph& v, bool springs, const Theme& theme) {
  for (const RodShape& rod : v.shape->rods) {
    if (rod.springs != springs) continue;
    const ImVec2 a = camera.screen(placed(v, rod.from_body) * rod.from),
                 b = camera.screen(placed(v, rod.to_body) * rod.to);
    if (v.outline)
      dashed_line(draw, {a, b}, v.colour, theme.px(1.5f), theme.px(6), theme.px(4));
    else if (springs)
      draw_spring(draw, a, b, v.colour, theme);
    else
      draw.AddLine(a, b, v.colour, std::max(theme.px(2), float(0.016 * camera.px_per_m)));
  }
}

void draw_wheels(ImDrawList& draw, const Camera& camera, const VehicleGlyph& v, const Theme& theme) {
  for (const FreeCastorShape& castor : v.shape->free_castors)
    draw.AddCircle(camera.screen(placed(v, castor.body) * castor.place),
                   std::max(1.5f, float(castor.radius_m * camera.px_per_m)), theme.muted, 0, theme.px(1.2f));
  for (std::size_t i = 0; i < v.shape->wheels.size(); ++i) {
    const WheelShape& wheel = v.shape->wheels[i];
    if (wheel.contact_length_m > 0.0)
      draw_track_of(draw, camera, wheel_pose(v, i), wheel, v.posture.wheels[i], theme);
    else
      draw_wheel(draw, camera, wheel_pose(v, i), wheel, v.posture.wheels[i], theme);
  }
}

void draw_joints(ImDrawList& draw, const Camera& camera, const VehicleGlyph& v, const Theme& theme) {
  for (const JointShape& joint : v.shape->joints) {
    const ImVec2 at = camera.screen(placed(v, joint.body) * joint.place);
    const float radius = std::clamp(float(0.012 * camera.px_per_m), theme.px(2.2f), theme.px(5));
    draw.AddCircleFilled(at, radius, theme.panel);
    draw.AddCircle(at, radius, v.colour, 0, theme.px(1.6f));
  }
}

}  // namespace

void draw_vehicle(ImDrawList& draw, const Camera& camera, const VehicleGlyph& v, const Theme& theme) {
  if (!v.shape) return;
  draw_bodies(draw, camera, v, Layer::below, theme);
  draw_bodies(draw, camera, v, Layer::bodies, theme);
  draw_rods(draw, camera, v, false, theme);
  if (!v.outline) draw_wheels(draw, camera, v, theme);
  draw_bodies(draw, camera, v, Layer::above, theme);
  draw_rods(draw, camera, v, true, theme);
  if (!v.outline) draw_joints(draw, camera, v, theme);
  // The point that every pose on the screen is the pose of, and the way ahead.
  const ImVec2 centre = camera.screen(v.pose.position());
  draw.AddCircleFilled(centre, theme.px(v.outline ? 3.0f : 3.5f), v.colour);
  double reach_m = 0.0;
  for (const Vec2 corner : v.shape->bodies.empty() ? std::vector<Vec2>{} : v.shape->bodies.front().outline)
    reach_m = std::max(reach_m, corner.x_m);
  const float reach = std::max(float(0.5 * reach_m * camera.px_per_m), theme.px(10));
  const double heading = v.pose.heading_rad;
  draw_arrow(draw, centre, {centre.x + reach * float(std::cos(heading)), centre.y - reach * float(std::sin(heading))},
             v.colour, theme.px(1.8f), theme.px(6));
}

double reach_of(const VehicleGlyph& v) {
  double reach_m = 0.0;
  const auto take = [&](Vec2 p) { reach_m = std::max(reach_m, length(p - v.pose.position())); };
  if (!v.shape) return reach_m;
  for (std::size_t i = 0; i < v.shape->bodies.size(); ++i)
    for (const Vec2 p : v.shape->bodies[i].outline) take(placed(v, int(i)) * p);
  for (std::size_t i = 0; i < v.shape->wheels.size(); ++i) {
    const WheelShape& w = v.shape->wheels[i];
    for (const Vec2 p : box(w.radius_m + 0.5 * w.contact_length_m, 0.5 * w.width_m)) take(wheel_pose(v, i) * p);
  }
  return 0.1 *
         std::ceil(10.0 * reach_m - 1e-9);  // so that links and trailers that swing do not let a fitted view swing
}

}  // namespace odolab::ui
