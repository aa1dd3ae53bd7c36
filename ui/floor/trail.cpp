#include "ui/floor/trail.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/diagnosis/mismatch.h"
#include "ui/look/strokes.h"

namespace odolab::ui {

namespace {

constexpr double kFinest_m = 0.002;
constexpr std::size_t kFewEnough = 400;  // points: no coarser level is worth its memory

bool is_in(const std::vector<Stretch>& stretches, double time_s) {
  return std::any_of(stretches.begin(), stretches.end(),
                     [&](const Stretch& s) { return time_s >= s.first && time_s <= s.second; });
}

}  // namespace

Trail::Trail(std::vector<double> time_s, const std::vector<double>& x_m, const std::vector<double>& y_m,
             const std::vector<double>& size) {
  assert(time_s.size() == x_m.size() && x_m.size() == y_m.size() && (size.empty() || size.size() == x_m.size()));
  Level all;
  lowest_ = {1e300, 1e300};
  highest_ = {-1e300, -1e300};
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    if (!std::isfinite(x_m[i]) || !std::isfinite(y_m[i])) continue;
    const bool sized = !size.empty() && std::isfinite(size[i]);
    all.points.push_back({time_s[i], {x_m[i], y_m[i]}, sized ? float(size[i]) : 0.0f});
    lowest_ = {std::min(lowest_.x_m, x_m[i]), std::min(lowest_.y_m, y_m[i])};
    highest_ = {std::max(highest_.x_m, x_m[i]), std::max(highest_.y_m, y_m[i])};
  }
  levels_.push_back(std::move(all));
  for (double apart_m = kFinest_m; levels_.back().points.size() > kFewEnough; apart_m *= 2.0) {
    Level next;
    next.apart_m = apart_m;
    const std::vector<Point>& before = levels_.back().points;
    float largest = 0.0f;
    for (std::size_t i = 0; i < before.size(); ++i) {
      largest = std::max(largest, before[i].size);
      const bool kept =
          next.points.empty() || i + 1 == before.size() || length(before[i].at - next.points.back().at) >= apart_m;
      if (!kept) continue;
      next.points.push_back(before[i]);
      next.points.back().size = largest;
      largest = 0.0f;
    }
    if (next.points.size() < 3) break;
    if (10 * next.points.size() < 7 * before.size()) levels_.push_back(std::move(next));
  }
}

const std::vector<Trail::Point>& Trail::points(double apart_m) const {
  static const std::vector<Point> kNone;
  if (levels_.empty()) return kNone;
  const Level* level = &levels_.front();
  for (const Level& l : levels_)
    if (l.apart_m <= apart_m) level = &l;
  return level->points;
}

std::vector<Stretch> Trail::inside(Vec2 a, Vec2 b, double join_s) const {
  std::vector<Stretch> found;
  if (levels_.empty()) return found;
  const Vec2 low{std::min(a.x_m, b.x_m), std::min(a.y_m, b.y_m)}, high{std::max(a.x_m, b.x_m), std::max(a.y_m, b.y_m)};
  for (const Point& p : levels_.front().points) {
    const bool in = p.at.x_m >= low.x_m && p.at.x_m <= high.x_m && p.at.y_m >= low.y_m && p.at.y_m <= high.y_m;
    if (!in) continue;
    if (!found.empty() && p.time_s - found.back().second < join_s)
      found.back().second = p.time_s;
    else
      found.emplace_back(p.time_s, p.time_s);
  }
  return found;
}

void draw_trail(ImDrawList& draw, const Camera& camera, const Trail& trail, ImU32 colour, float width,
                const Theme& theme) {
  std::vector<ImVec2> line;
  for (const Trail::Point& p : trail.points(theme.px(4) / camera.px_per_m)) line.push_back(camera.screen(p.at));
  solid_line(draw, line, colour, width);
}

ImU32 mismatch_colour(int level, const Theme& theme) {
  // From pale to dark on paper, to light on a dark ground, so that it can be read in grey too.
  static constexpr unsigned kLight[kMismatchLevels] = {0xB9C4CC, 0xF0C040, 0xE69F00, 0xD55E00, 0x8B1A1A};
  static constexpr unsigned kDark[kMismatchLevels] = {0x4B5661, 0xB8961E, 0xE8A21A, 0xFF7A2E, 0xFFDCC4};
  assert(level >= 0 && level < kMismatchLevels);
  return rgb(theme.dark ? kDark[level] : kLight[level]);
}

float mismatch_width(int level, const Theme& theme) { return theme.px(2.2f + 0.65f * float(level)); }

void draw_mismatch(ImDrawList& draw, const Camera& camera, const Trail& trail, const std::vector<Stretch>& lit,
                   const Theme& theme) {
  const std::vector<Trail::Point>& points = trail.points(theme.px(1.5f) / camera.px_per_m);
  for (int level = 0; level < kMismatchLevels; ++level) {
    std::vector<ImVec2> line;
    bool line_is_lit = true;
    const auto close = [&] {
      const ImU32 colour = mismatch_colour(level, theme);
      const float width = mismatch_width(level, theme);
      if (!lit.empty() && line_is_lit) solid_line(draw, line, faded(theme.sky, 0.45f), width + theme.px(8));
      solid_line(draw, line, line_is_lit ? colour : faded(colour, 0.3f), width);
      line.clear();
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool is_lit = lit.empty() || is_in(lit, points[i].time_s);
      if (mismatch_level(double(points[i].size)) != level || is_lit != line_is_lit) {
        close();
        line_is_lit = is_lit;
        if (mismatch_level(double(points[i].size)) != level) continue;
      }
      if (line.empty() && i > 0) line.push_back(camera.screen(points[i - 1].at));
      line.push_back(camera.screen(points[i].at));
    }
    close();
  }
}

}  // namespace odolab::ui
