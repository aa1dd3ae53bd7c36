#include "ui/floor/drawing.h"

#include <algorithm>
#include <cmath>

#include "ui/look/strokes.h"
#include "ui/look/units.h"
#include "ui/plot/ticks.h"

namespace odolab::ui {

namespace {

std::vector<ImVec2> outline_of(const Camera& camera, const Shape& shape) {
  std::vector<ImVec2> outline;
  if (const Disc* disc = std::get_if<Disc>(&shape)) {
    const int n = std::clamp(int(disc->radius_m * camera.px_per_m), 24, 128);
    for (int i = 0; i < n; ++i)
      outline.push_back(camera.screen(disc->centre + rotated({disc->radius_m, 0.0}, 2.0 * kPi * i / n)));
  } else if (const Rectangle* r = std::get_if<Rectangle>(&shape)) {
    for (const Vec2 corner : {Vec2{-0.5, -0.5}, Vec2{0.5, -0.5}, Vec2{0.5, 0.5}, Vec2{-0.5, 0.5}})
      outline.push_back(
          camera.screen(r->centre + rotated({corner.x_m * r->width_m, corner.y_m * r->height_m}, r->direction_rad)));
  } else {
    for (const Vec2 corner : std::get<Polygon>(shape).corners) outline.push_back(camera.screen(corner));
  }
  return outline;
}

// Parallel lines at 45 degrees inside an outline, by where they cross its edges.
void hatch(ImDrawList& draw, const std::vector<ImVec2>& outline, float spacing, ImU32 colour, float width) {
  const ImVec2 clip_low = draw.GetClipRectMin(), clip_high = draw.GetClipRectMax();
  float least = 1e30f, most = -1e30f;
  for (const ImVec2 p : outline) {
    least = std::min(least, p.x + p.y);
    most = std::max(most, p.x + p.y);
  }
  least = std::max(least, clip_low.x + clip_low.y);
  most = std::min(most, clip_high.x + clip_high.y);
  for (float c = std::ceil(least / spacing) * spacing; c < most; c += spacing) {
    std::vector<float> crossings;  // x on the line x + y = c
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
      const float a = outline[j].x + outline[j].y - c, b = outline[i].x + outline[i].y - c;
      if ((a > 0.0f) == (b > 0.0f)) continue;
      crossings.push_back(outline[j].x + (outline[i].x - outline[j].x) * a / (a - b));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      draw.AddLine({crossings[k], c - crossings[k]}, {crossings[k + 1], c - crossings[k + 1]}, colour, width);
  }
}

}  // namespace

void draw_arrow(ImDrawList& draw, ImVec2 from, ImVec2 to, ImU32 colour, float width, float head) {
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  if (length < 1.0f) return;
  const ImVec2 d{(to.x - from.x) / length, (to.y - from.y) / length};
  const ImVec2 base{to.x - d.x * head, to.y - d.y * head};
  draw.AddLine(from, base, colour, width);
  draw.AddTriangleFilled(to, {base.x - d.y * head * 0.5f, base.y + d.x * head * 0.5f},
                         {base.x + d.y * head * 0.5f, base.y - d.x * head * 0.5f}, colour);
}

std::pair<Vec2, Vec2> ends_of(const Bump& bump) {
  const Vec2 half = rotated({0.5 * bump.length_m, 0.0}, bump.direction_rad);
  return {bump.centre - half, bump.centre + half};
}

Pose exaggerated(const Pose& reference, const Pose& deviating, double factor) {
  return {reference.x_m + factor * (deviating.x_m - reference.x_m),
          reference.y_m + factor * (deviating.y_m - reference.y_m),
          reference.heading_rad + factor * (deviating.heading_rad - reference.heading_rad)};
}

void draw_grid(ImDrawList& draw, const Camera& camera, const Theme& theme) {
  draw.AddRectFilled(camera.low, camera.high, theme.paper);
  const Vec2 low = camera.floor({camera.low.x, camera.high.y}), high = camera.floor({camera.high.x, camera.low.y});
  const double step = round_step(high.x_m - low.x_m, std::max(2, int((camera.high.x - camera.low.x) / theme.px(64))));
  const double fine = step / 5.0;
  for (int pass = 0; pass < 2; ++pass) {
    const double d = pass == 0 ? fine : step;
    const ImU32 colour = pass == 0 ? theme.faint : theme.line;
    for (double k = std::ceil(low.x_m / d); k * d <= high.x_m; k += 1.0) {
      const float x = std::round(camera.screen({k * d, 0.0}).x);
      draw.AddLine({x, camera.low.y}, {x, camera.high.y}, colour);
    }
    for (double k = std::ceil(low.y_m / d); k * d <= high.y_m; k += 1.0) {
      const float y = std::round(camera.screen({0.0, k * d}).y);
      draw.AddLine({camera.low.x, y}, {camera.high.x, y}, colour);
    }
  }
  // Rulers along the left and the bottom edge; the metres stand at the last number.
  const float height = ImGui::GetTextLineHeight();
  for (const double v :
       round_ticks(low.x_m, high.x_m, std::max(2, int((camera.high.x - camera.low.x) / theme.px(64))))) {
    const float x = camera.screen({v, 0.0}).x;
    const std::string text = tick_text(v, step) + " m";
    const float w = ImGui::CalcTextSize(text.c_str()).x;
    if (x - w / 2 < camera.low.x + theme.px(50) || x + w / 2 > camera.high.x - theme.px(4)) continue;
    draw.AddText({std::round(x - w / 2), camera.high.y - height - theme.px(4)}, theme.muted, text.c_str());
  }
  for (double k = std::ceil(low.y_m / step); k * step <= high.y_m; k += 1.0) {
    const float y = camera.screen({0.0, k * step}).y;
    if (y > camera.high.y - 2.2f * height || y < camera.low.y + 2.4f * height) continue;
    draw.AddText({camera.low.x + theme.px(6), std::round(y - height / 2)}, theme.muted,
                 (tick_text(k * step, step) + " m").c_str());
  }
}

void draw_origin(ImDrawList& draw, const Camera& camera, const Theme& theme) {
  const ImVec2 o = camera.screen({0.0, 0.0});
  const float l = theme.px(26), halo = theme.px(1.5f);
  for (const ImVec2 tip : {ImVec2(o.x + l, o.y), ImVec2(o.x, o.y - l)}) {
    draw.AddLine(o, tip, faded(theme.paper, 0.9f), theme.px(5));
    draw_arrow(draw, o, tip, theme.muted, theme.px(1.5f), theme.px(7));
  }
  const auto letter = [&](ImVec2 at, const char* text) {
    for (const float dx : {-halo, 0.0f, halo})
      for (const float dy : {-halo, 0.0f, halo}) draw.AddText({at.x + dx, at.y + dy}, theme.paper, text);
    draw.AddText(at, theme.ink, text);
  };
  letter({o.x + l - theme.px(4), o.y + theme.px(1)}, "x");
  letter({o.x - theme.px(12), o.y - l - theme.px(4)}, "y");
}

void draw_scale_bar(ImDrawList& draw, const Camera& camera, const Theme& theme) {
  const double metres = round_step(camera.width_m(), 9);
  const float length = float(metres * camera.px_per_m);
  const float height = ImGui::GetTextLineHeight();
  const ImVec2 right{camera.high.x - theme.px(14), camera.high.y - height - theme.px(14)};
  const ImVec2 left{right.x - length, right.y};
  const std::string text =
      metres < 0.0995 ? shown(metres, kMillimetres, metres < 0.00095 ? 1 : 0) : tick_text(metres, metres) + " m";
  const float w = ImGui::CalcTextSize(text.c_str()).x;
  draw.AddRectFilled({left.x - theme.px(6), right.y - height - theme.px(8)},
                     {right.x + theme.px(6), right.y + theme.px(6)}, faded(theme.paper, 0.85f), theme.px(3));
  draw.AddLine(left, right, theme.ink, theme.px(2));
  for (const ImVec2 end : {left, right})
    draw.AddLine({end.x, end.y - theme.px(4)}, {end.x, end.y + theme.px(4)}, theme.ink, theme.px(2));
  draw.AddText({std::round(0.5f * (left.x + right.x - w)), right.y - height - theme.px(5)}, theme.ink, text.c_str());
}

void draw_bump(ImDrawList& draw, const Camera& camera, const Bump& bump, bool selected, const Theme& theme) {
  const auto [a, b] = ends_of(bump);
  const ImVec2 p = camera.screen(a), q = camera.screen(b);
  const float width = std::max(theme.px(5), float(2.0 * bump.height_m * camera.px_per_m));
  if (selected) draw.AddLine(p, q, faded(theme.sky, 0.6f), width + theme.px(8));
  draw.AddLine(p, q, theme.bump_edge, width + theme.px(2.5f));
  draw.AddLine(p, q, theme.bump, width);
  if (selected)
    for (const ImVec2 end : {p, q}) {
      draw.AddCircleFilled(end, theme.px(6), theme.paper);
      draw.AddCircle(end, theme.px(6), theme.ink, 0, theme.px(1.5f));
    }
}

void draw_slip_zone(ImDrawList& draw, const Camera& camera, const SlipZone& zone, bool selected, const Theme& theme) {
  const std::vector<ImVec2> outline = outline_of(camera, zone.shape);
  if (outline.size() < 3) return;
  if (!std::holds_alternative<Polygon>(zone.shape))
    draw.AddConvexPolyFilled(outline.data(), int(outline.size()), faded(theme.zone, 0.10f));
  hatch(draw, outline, theme.px(9), faded(theme.zone, 0.65f), theme.px(1));
  draw.AddPolyline(outline.data(), int(outline.size()), selected ? theme.ink : theme.zone, ImDrawFlags_Closed,
                   theme.px(selected ? 2.0f : 1.5f));
  if (!selected) return;
  const Disc* disc = std::get_if<Disc>(&zone.shape);
  const Rectangle* r = std::get_if<Rectangle>(&zone.shape);
  if (!disc && !r) return;
  const Vec2 handle = disc ? disc->centre + Vec2{disc->radius_m, 0.0}
                           : r->centre + rotated({0.5 * r->width_m, 0.5 * r->height_m}, r->direction_rad);
  draw.AddCircleFilled(camera.screen(handle), theme.px(6), theme.paper);
  draw.AddCircle(camera.screen(handle), theme.px(6), theme.ink, 0, theme.px(1.5f));
}

void draw_tilt(ImDrawList& draw, const Camera& camera, const Floor& floor, const Theme& theme) {
  if (floor.tilt_rad == 0.0) return;
  const float l = theme.px(30);
  const ImVec2 at{camera.high.x - theme.px(60), camera.low.y + theme.px(52)};
  const ImVec2 d{float(std::cos(floor.downhill_direction_rad)), -float(std::sin(floor.downhill_direction_rad))};
  draw.AddCircleFilled(at, l + theme.px(6), faded(theme.paper, 0.85f));
  draw.AddCircle(at, l + theme.px(6), theme.line);
  draw_arrow(draw, {at.x - d.x * l, at.y - d.y * l}, {at.x + d.x * l, at.y + d.y * l}, theme.ink, theme.px(3),
             theme.px(13));
  const std::string text = "downhill " + shown(std::abs(floor.tilt_rad), kDegrees, 1);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  draw.AddText({std::round(std::min(at.x - size.x / 2, camera.high.x - size.x - theme.px(6))), at.y + l + theme.px(9)},
               theme.ink, text.c_str());
}

void draw_planned(ImDrawList& draw, const Camera& camera, const std::vector<Vec2>& path, const Theme& theme) {
  std::vector<ImVec2> points;
  for (const Vec2 p : path) points.push_back(camera.screen(p));
  dashed_line(draw, points, faded(theme.muted, 0.8f), theme.px(1.2f), theme.px(2), theme.px(4));
}

void draw_stroke(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 colour, Dash dash, const Theme& theme) {
  switch (dash) {
    case Dash::solid:
      solid_line(draw, points, colour, theme.px(2.0f));
      break;
    case Dash::dashes:
      dashed_line(draw, points, colour, theme.px(2.2f), theme.px(8), theme.px(5));
      break;
    case Dash::dots:
      dashed_line(draw, points, colour, theme.px(2.6f), theme.px(2.6f), theme.px(5.4f));
      break;
    case Dash::long_dashes:
      dashed_line(draw, points, colour, theme.px(2.0f), theme.px(16), theme.px(4));
      break;
  }
}

namespace {

// Where a line has been drawn, in cells of some pixels: an hour of laps has no more to draw than one.
class Inked {
 public:
  Inked(ImVec2 low, ImVec2 high, float cell)
      : low_(low),
        cell_(cell),
        columns_(std::max(1, int((high.x - low.x) / cell) + 1)),
        rows_(std::max(1, int((high.y - low.y) / cell) + 1)),
        at_(std::size_t(columns_) * std::size_t(rows_), kNever) {}

  // Whether the line came by here before, longer ago than the way that it takes to leave this place.
  bool before(ImVec2 p, float along) const {
    const int x = column(p), y = row(p);
    for (int j = std::max(0, y - 1); j <= std::min(rows_ - 1, y + 1); ++j)
      for (int i = std::max(0, x - 1); i <= std::min(columns_ - 1, x + 1); ++i)
        if (at_[std::size_t(j) * std::size_t(columns_) + std::size_t(i)] < along - 12.0f * cell_) return true;
    return false;
  }
  void draw(ImVec2 a, ImVec2 b, float along) {
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    const int steps = std::min(200, int(length / cell_) + 1);
    for (int k = 0; k <= steps; ++k) {
      const float u = float(k) / float(steps);
      const ImVec2 p{a.x + u * (b.x - a.x), a.y + u * (b.y - a.y)};
      const int x = column(p), y = row(p);
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
      float& at = at_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)];
      at = std::min(at, along);
    }
  }

 private:
  static constexpr float kNever = 1e30f;
  int column(ImVec2 p) const { return int(std::clamp(std::floor((p.x - low_.x) / cell_), -9.0f, 1e6f)); }
  int row(ImVec2 p) const { return int(std::clamp(std::floor((p.y - low_.y) / cell_), -9.0f, 1e6f)); }

  ImVec2 low_;
  float cell_;
  int columns_, rows_;
  std::vector<float> at_;
};

constexpr std::size_t kLong = 3000;  // points, from which on what was drawn before is not drawn again

// A long line but for what would lie on itself.
void draw_long_stroke(ImDrawList& draw, const std::vector<ImVec2>& points, ImU32 colour, Dash dash,
                      const Theme& theme) {
  Inked inked(draw.GetClipRectMin(), draw.GetClipRectMax(), theme.px(2));
  std::vector<ImVec2> piece{points.front()};
  float along = 0.0f;
  bool was_before = false;
  for (std::size_t i = 1; i < points.size(); ++i) {
    along += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
    const bool is_before = inked.before(points[i], along);
    if (is_before && was_before) {
      if (piece.size() > 1) draw_stroke(draw, piece, colour, dash, theme);
      piece.clear();
    } else {
      if (piece.empty()) piece.push_back(points[i - 1]);
      piece.push_back(points[i]);
      inked.draw(points[i - 1], points[i], along);
    }
    was_before = is_before;
  }
  if (piece.size() > 1) draw_stroke(draw, piece, colour, dash, theme);
}

}  // namespace

void draw_track(ImDrawList& draw, const Camera& camera, const TrackLine& line, double exaggeration,
                const Theme& theme) {
  if (!line.track) return;
  std::vector<ImVec2> points;
  ImVec2 last{-1e9f, -1e9f};
  std::size_t r = 1;
  for (const TimedPose& p : *line.track) {
    if (p.time_s > line.until_s) break;
    Vec2 at = p.pose.position();
    if (line.reference && line.reference->size() > 1 && exaggeration != 1.0) {
      const Track& ref = *line.reference;
      while (r + 1 < ref.size() && ref[r].time_s < p.time_s) ++r;
      const double span = ref[r].time_s - ref[r - 1].time_s;
      const double u = span > 0.0 ? std::clamp((p.time_s - ref[r - 1].time_s) / span, 0.0, 1.0) : 1.0;
      const Vec2 true_at = ref[r - 1].pose.position() + u * (ref[r].pose.position() - ref[r - 1].pose.position());
      at = true_at + exaggeration * (at - true_at);
    }
    const ImVec2 s = camera.screen(at);
    if (std::abs(s.x - last.x) + std::abs(s.y - last.y) < theme.px(1.5f)) continue;  // no more points than pixels
    points.push_back(s);
    last = s;
  }
  if (line.end && !points.empty()) points.push_back(camera.screen(line.end->position()));
  if (points.size() > kLong)
    draw_long_stroke(draw, points, line.colour, line.dash, theme);
  else
    draw_stroke(draw, points, line.colour, line.dash, theme);
}

}  // namespace odolab::ui
