#include "core/io/picture/track_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/picture/axis.h"

namespace odolab {

namespace {

constexpr double kTop_px = 46.0, kSide_px = 18.0, kBottom_px = 58.0;

struct Box {
  double left = std::numeric_limits<double>::infinity(), right = -left, low = left, high = -left;

  void include(Vec2 p) {
    if (!std::isfinite(p.x_m) || !std::isfinite(p.y_m)) return;
    left = std::min(left, p.x_m);
    right = std::max(right, p.x_m);
    low = std::min(low, p.y_m);
    high = std::max(high, p.y_m);
  }
};

std::vector<Vec2> outline(const Shape& shape) {
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

struct View {
  double scale_px = 1.0, left_px = 0.0, top_px = 0.0;
  Box box;

  Point at(Vec2 p) const { return {left_px + (p.x_m - box.left) * scale_px, top_px + (box.high - p.y_m) * scale_px}; }
};

View view_of(const TrackPicture& picture) {
  View view;
  Box& box = view.box;
  for (const DrawnTrack& drawn : picture.tracks)
    for (const TimedPose& p : drawn.track) box.include(p.pose.position());
  if (!(box.left <= box.right)) {
    for (const SlipZone& zone : picture.floor.slip_zones)
      for (Vec2 corner : outline(zone.shape)) box.include(corner);
    for (const Bump& bump : picture.floor.bumps) box.include(bump.centre);
  }
  if (!(box.left <= box.right)) box.include({0.0, 0.0});
  // a robot's width of air, and never less than half a metre across
  const double air = std::max({0.3, 0.06 * (box.right - box.left), 0.06 * (box.high - box.low)});
  box = {box.left - air, box.right + air, box.low - air, box.high + air};
  const double width_px = picture.width_px - 2.0 * kSide_px, height_px = picture.height_px - kTop_px - kBottom_px;
  view.scale_px = std::min(width_px / (box.right - box.left), height_px / (box.high - box.low));
  // the floor fills the picture: what is left over on one axis is shown too
  const double more_x = 0.5 * (width_px / view.scale_px - (box.right - box.left));
  const double more_y = 0.5 * (height_px / view.scale_px - (box.high - box.low));
  box = {box.left - more_x, box.right + more_x, box.low - more_y, box.high + more_y};
  view.left_px = kSide_px;
  view.top_px = kTop_px;
  return view;
}

void draw_grid(Svg& svg, const View& view, double step_m) {
  const Box& b = view.box;
  for (double k = std::ceil(b.left / step_m); k * step_m <= b.right; k += 1.0)
    svg.line(view.at({k * step_m, b.low}), view.at({k * step_m, b.high}), {ink::kGrid, 1.0, ""});
  for (double k = std::ceil(b.low / step_m); k * step_m <= b.high; k += 1.0)
    svg.line(view.at({b.left, k * step_m}), view.at({b.right, k * step_m}), {ink::kGrid, 1.0, ""});
}

// Points nearer than half a pixel to the last one drawn are not seen.
std::vector<Point> thinned(const Track& track, const View& view) {
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

void draw_start(Svg& svg, const View& view, const Pose& start) {
  const Point at = view.at(start.position());
  const auto corner = [&](double ahead, double left) {
    const Vec2 d = rotated({ahead, left}, start.heading_rad);
    return Point{at.x + d.x_m, at.y - d.y_m};
  };
  svg.polygon({corner(15, 0), corner(-8, 8), corner(-4, 0), corner(-8, -8)}, "#ffffff", {ink::kTruth, 1.6, ""});
}

void draw_scale_bar(Svg& svg, const View& view, const TrackPicture& picture) {
  const double length_m = round_step((picture.width_px - 2.0 * kSide_px) / view.scale_px, 5);
  const double right = picture.width_px - kSide_px, y = picture.height_px - 22.0,
               left = right - length_m * view.scale_px;
  svg.line({left, y}, {right, y}, {ink::kText, 2.0, ""});
  svg.line({left, y - 4}, {left, y + 4}, {ink::kText, 2.0, ""});
  svg.line({right, y - 4}, {right, y + 4}, {ink::kText, 2.0, ""});
  svg.text({0.5 * (left + right), y - 8}, tick_text(length_m, length_m) + " m", Anchor::middle);
}

}  // namespace

std::string track_picture(const TrackPicture& picture) {
  Svg svg(picture.width_px, picture.height_px, picture.title);
  const View view = view_of(picture);
  const double width_px = picture.width_px - 2.0 * kSide_px, height_px = picture.height_px - kTop_px - kBottom_px;
  double grid_m = 1.0;  // metres, unless that would be a net too fine or one line alone
  if (view.scale_px < 12.0 || view.scale_px > 400.0) grid_m = round_step(width_px / view.scale_px, 10);
  svg.text({kSide_px, 28.0}, picture.title, Anchor::start, 16.0, ink::kText, true);

  const std::string hatching = picture.floor.slip_zones.empty() ? "" : svg.hatching();
  svg.begin_clip({kSide_px, kTop_px}, width_px, height_px);
  svg.rectangle({kSide_px, kTop_px}, width_px, height_px, "#ffffff");
  draw_grid(svg, view, grid_m);
  for (const SlipZone& zone : picture.floor.slip_zones) {
    std::vector<Point> corners;
    for (Vec2 c : outline(zone.shape)) corners.push_back(view.at(c));
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
    draw_start(svg, view, picture.tracks.front().track.front().pose);
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
  draw_scale_bar(svg, view, picture);
  return svg.finished();
}

}  // namespace odolab
