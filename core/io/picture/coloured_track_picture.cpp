#include "core/io/picture/coloured_track_picture.h"

#include <cassert>
#include <cmath>

#include "core/base/letters.h"
#include "core/diagnosis/mismatch.h"
#include "core/io/picture/floor_view.h"

namespace odolab {

namespace {

// From pale to dark, so that it can be read in grey too.
struct Level {
  const char* colour;
  double width_px;
};
constexpr Level kLevels[kMismatchLevels] = {
    {"#b9c4cc", 2.0}, {"#F0C040", 3.0}, {"#E69F00", 3.6}, {"#D55E00", 4.2}, {"#8B1A1A", 4.8}};

std::size_t level_of(double value) { return static_cast<std::size_t>(mismatch_level(value)); }

// The line from point to point at one level; every stretch begins where the one before it ended.
void draw_level(Svg& svg, const ColouredTrack& track, const FloorView& view, std::size_t level) {
  std::vector<Point> line;
  Point last{};
  bool has_last = false;
  const auto close = [&] {
    if (!line.empty() && has_last) line.push_back(last);  // which may lie too near to be drawn before
    svg.polyline(line, {kLevels[level].colour, kLevels[level].width_px, ""});
    line.clear();
  };
  for (std::size_t i = 0; i < track.x_m.size(); ++i) {
    if (!std::isfinite(track.x_m[i]) || !std::isfinite(track.y_m[i])) {
      close();
      has_last = false;
      continue;
    }
    const Point p = view.at({track.x_m[i], track.y_m[i]});
    if (std::isfinite(track.times_noise[i]) && level_of(track.times_noise[i]) == level) {
      if (line.empty() && has_last) line.push_back(last);
      if (line.empty() || std::hypot(p.x - line.back().x, p.y - line.back().y) >= 0.5) line.push_back(p);
    } else {
      close();
    }
    last = p;
    has_last = true;
  }
  close();
}

}  // namespace

std::string coloured_track_picture(const ColouredTrackPicture& picture) {
  const ColouredTrack& track = picture.track;
  assert(track.x_m.size() == track.y_m.size() && track.x_m.size() == track.times_noise.size());
  constexpr double kSide = 14.0, kTop = 40.0, kBottom = 50.0;
  FloorBox box;
  for (std::size_t i = 0; i < track.x_m.size(); ++i) box.include({track.x_m[i], track.y_m[i]});
  for (const MarkedDisc& disc : picture.discs) {
    box.include({disc.x_m - disc.radius_m, disc.y_m - disc.radius_m});
    box.include({disc.x_m + disc.radius_m, disc.y_m + disc.radius_m});
  }
  const FloorView view(box, {kSide, kTop}, picture.width_px - 2.0 * kSide, picture.height_px - kTop - kBottom);

  Svg svg(picture.width_px, picture.height_px, picture.title);
  svg.text({kSide, 25.0}, picture.title, Anchor::start, 14.0, ink::kText, true);
  svg.begin_clip(view.corner, view.width_px, view.height_px);
  svg.rectangle(view.corner, view.width_px, view.height_px, "#ffffff");
  view.draw_grid(svg);
  for (std::size_t level = 0; level < std::size(kLevels); ++level) draw_level(svg, track, view, level);
  for (const MarkedDisc& disc : picture.discs) {
    const Point centre = view.at({disc.x_m, disc.y_m});
    const double radius = std::max(6.0, disc.radius_m * view.scale_px);
    svg.circle(centre, radius, "none", {ink::kBlue, 2.0, "5 3"});
    const bool above = centre.y - radius > view.corner.y + 24.0;
    svg.text({centre.x, above ? centre.y - radius - 6.0 : centre.y + radius + 15.0}, disc.label, Anchor::middle, 12.0,
             ink::kBlue, true);
  }
  if (!box.empty() && track.x_m.size() > 1) {
    std::size_t first = 0;
    while (first < track.x_m.size() && !(std::isfinite(track.x_m[first]) && std::isfinite(track.y_m[first]))) ++first;
    if (first < track.x_m.size())
      svg.circle(view.at({track.x_m[first], track.y_m[first]}), 5.0, "#ffffff", {ink::kTruth, 1.8, ""});
  }
  svg.end_clip();
  svg.rectangle(view.corner, view.width_px, view.height_px, "none", {ink::kAxis, 1.0, ""});

  double x = kSide;
  const double y = picture.height_px - 18.0;
  for (int k = 0; k < kMismatchLevels; ++k) {
    const std::string label = mismatch_level_text(k);
    svg.line({x, y - 4.0}, {x + 20.0, y - 4.0}, {kLevels[k].colour, kLevels[k].width_px + 1.0, ""});
    svg.text({x + 25.0, y}, label, Anchor::start, 11.0);
    x += 36.0 + 6.0 * letters_of(label);
  }
  view.draw_scale_bar(svg, {picture.width_px - kSide, y}, 8);
  return svg.finished();
}

}  // namespace odolab
