#include "core/io/picture/track_picture.h"

#include <algorithm>
#include <cmath>

#include "core/io/picture/floor_view.h"

namespace odolab {

namespace {

constexpr double kTop_px = 46.0, kSide_px = 18.0, kBottom_px = 58.0;

std::vector<Vec2> outline_of_shape(const Shape& shape) {
  if (const auto* polygon = std::get_if<Polygon>(&shape)) return polygon->corners;
  std::vector<Vec2> corners;
  if (const auto* r = std::get_if<Rectangle>(&shape)) {
    const double w = 0.5 * r->width_m, h = 0.5 * r->height_m;
    for (Vec2 c : {Vec2{-w, -h}, Vec2{w, -h}, Vec2{w, h}, Vec2{-w, h}})
      corners.push_back(r->centre + rotated(c, r->direction_rad));
  } else {
    const Disc& disc = std::get<Disc>(shape);
    for (int i = 0; i < 72; ++i) corners.push_back(disc.centre + rotated({disc.radius_m, 0.0}, i * kPi / 36.0));
  }
  return corners;
}

std::pair<Vec2, Vec2> ends(const Bump& bump) {
  const Vec2 half = rotated({0.5 * bump.length_m, 0.0}, bump.direction_rad);
  return {bump.centre - half, bump.centre + half};
}

FloorView view_of(const TrackPicture& picture) {
  FloorBox box;
  for (const DrawnTrack& drawn : picture.tracks)
    for (const TimedPose& p : drawn.track) box.include(p.pose.position());
  if (box.empty()) {
    for (const SlipZone& zone : picture.floor.slip_zones)
      for (Vec2 corner : outline_of_shape(zone.shape)) box.include(corner);
    for (const Bump& bump : picture.floor.bumps) box.include(bump.centre);
  }
  return {box, {kSide_px, kTop_px}, picture.width_px - 2.0 * kSide_px, picture.height_px - kTop_px - kBottom_px};
}

// Points nearer than half a pixel to the last one drawn are not seen.
std::vector<Point> thinned(const Track& track, const FloorView& view) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Point p = view.at(track[i].pose.position());
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    const bool last = i + 1 == track.size();
    if (!points.empty() && !last && std::hypot(p.x - points.back().x, p.y - points.back().y) < 0.5) continue;
    points.push_back(p);
  }
  return points;
}

}  // namespace

std::string track_picture(const TrackPicture& picture) {
  Svg svg(picture.width_px, picture.height_px, picture.title);
  const FloorView view = view_of(picture);
  const double width_px = view.width_px, height_px = view.height_px;
  svg.text({kSide_px, 28.0}, picture.title, Anchor::start, 16.0, ink::kText, true);

  const std::string hatching = picture.floor.slip_zones.empty() ? "" : svg.hatching();
  svg.begin_clip({kSide_px, kTop_px}, width_px, height_px);
  svg.rectangle({kSide_px, kTop_px}, width_px, height_px, "#ffffff");
  view.draw_grid(svg);
  for (const SlipZone& zone : picture.floor.slip_zones) {
    std::vector<Point> corners;
    for (Vec2 c : outline_of_shape(zone.shape)) corners.push_back(view.at(c));
    svg.polygon(corners, hatching, {ink::kSky, 1.2, ""});
  }
  for (const Bump& bump : picture.floor.bumps) {
    const auto [from, to] = ends(bump);
    const double width_px_of_bump = std::clamp(2.0 * bump.height_m * view.scale_px, 3.0, 12.0);
    svg.line(view.at(from), view.at(to), {ink::kText, width_px_of_bump + 2.0, ""});
    svg.line(view.at(from), view.at(to), {ink::kYellow, width_px_of_bump, ""});
  }
  for (const DrawnTrack& drawn : picture.tracks) svg.polyline(thinned(drawn.track, view), stroke_of(drawn.look));
  if (!picture.tracks.empty() && !picture.tracks.front().track.empty())
    view.draw_start(svg, picture.tracks.front().track.front().pose);
  svg.end_clip();
  svg.rectangle({kSide_px, kTop_px}, width_px, height_px, "none", {ink::kAxis, 1.0, ""});

  double x = kSide_px;
  const double y = picture.height_px - 22.0;
  const auto advance = [&](const std::string& label) { x += 54.0 + 7.4 * static_cast<double>(label.size()); };
  for (const DrawnTrack& drawn : picture.tracks) {
    svg.line({x, y - 4}, {x + 30, y - 4}, stroke_of(drawn.look));
    svg.text({x + 36, y}, drawn.label);
    advance(drawn.label);
  }
  if (!picture.floor.bumps.empty()) {
    svg.line({x, y - 4}, {x + 30, y - 4}, {ink::kText, 7.0, ""});
    svg.line({x, y - 4}, {x + 30, y - 4}, {ink::kYellow, 5.0, ""});
    svg.text({x + 36, y}, "bump");
    advance("bump");
  }
  if (!picture.floor.slip_zones.empty()) {
    svg.rectangle({x, y - 11}, 30, 14, hatching, {ink::kSky, 1.2, ""});
    svg.text({x + 36, y}, "slip zone");
  }
  view.draw_scale_bar(svg, {picture.width_px - kSide_px, y});
  return svg.finished();
}

}  // namespace odolab
