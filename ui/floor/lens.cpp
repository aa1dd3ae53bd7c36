#include "ui/floor/lens.h"

#include <algorithm>
#include <cmath>

#include "ui/floor/drawing.h"
#include "ui/look/strokes.h"
#include "ui/look/units.h"
#include "ui/plot/ticks.h"

namespace odolab::ui {

namespace {

void pose_mark(ImDrawList& draw, const Camera& camera, const Pose& pose, ImU32 colour, bool dashed,
               const Theme& theme) {
  const ImVec2 at = camera.screen(pose.position());
  const float l = theme.px(34);
  const ImVec2 tip{at.x + l * float(std::cos(pose.heading_rad)), at.y - l * float(std::sin(pose.heading_rad))};
  if (dashed)
    dashed_line(draw, {at, tip}, colour, theme.px(2), theme.px(6), theme.px(4));
  else
    draw.AddLine(at, tip, colour, theme.px(2));
  draw.AddCircleFilled(at, theme.px(5), colour);
  draw.AddCircle(at, theme.px(5), theme.paper, 0, theme.px(1.2f));
}

}  // namespace

double lens_magnification(double gap_m, double px_per_m, double lens_radius_px) {
  const double wanted = 0.7 * lens_radius_px / std::max(gap_m * px_per_m, 1e-9);
  double magnification = 1e-4;
  for (double decade = 1e-4; decade <= 1000.0; decade *= 10.0)
    for (const double factor : {1.0, 2.0, 5.0})
      if (decade * factor <= wanted && decade * factor <= 1000.0)
        magnification = std::max(magnification, decade * factor);
  return magnification;
}

void draw_lens(ImDrawList& draw, ImVec2 low, ImVec2 high, const FloorScene& scene, double px_per_m,
               const Theme& theme) {
  if (!scene.reference || !scene.deviating) return;
  const Pose& reference = *scene.reference;
  const Pose& deviating = *scene.deviating;
  const float line = ImGui::GetTextLineHeight();
  const float head = line + theme.px(8);
  const double gap_m = length(deviating.position() - reference.position());
  Camera camera;
  camera.low = {low.x, low.y + head};
  camera.high = {high.x, high.y};
  const double magnification =
      lens_magnification(gap_m, px_per_m, 0.5 * std::min(camera.high.x - camera.low.x, camera.high.y - camera.low.y));
  if (magnification <= 1.0) return;  // nothing to enlarge: the floor shows it
  camera.px_per_m = px_per_m * magnification;
  camera.centre = 0.5 * (reference.position() + deviating.position());

  draw.AddRectFilled({low.x + theme.px(2), low.y + theme.px(3)}, {high.x + theme.px(2), high.y + theme.px(4)},
                     IM_COL32(0, 0, 0, 28), theme.px(5));
  draw.AddRectFilled(low, high, theme.paper, theme.px(4));
  draw.PushClipRect(camera.low, camera.high, true);
  const double step = round_step(camera.width_m(), 6);
  const Vec2 a = camera.floor({camera.low.x, camera.high.y}), b = camera.floor({camera.high.x, camera.low.y});
  for (double k = std::ceil(a.x_m / step); k * step <= b.x_m; k += 1.0) {
    const float x = std::round(camera.screen({k * step, 0.0}).x);
    draw.AddLine({x, camera.low.y}, {x, camera.high.y}, theme.faint);
  }
  for (double k = std::ceil(a.y_m / step); k * step <= b.y_m; k += 1.0) {
    const float y = std::round(camera.screen({0.0, k * step}).y);
    draw.AddLine({camera.low.x, y}, {camera.high.x, y}, theme.faint);
  }
  for (const TrackLine& track : scene.tracks) {
    TrackLine faint = track;
    faint.colour = faded(track.colour, 0.35f);
    draw_track(draw, camera, faint, 1.0, theme);
  }
  draw.AddLine(camera.screen(reference.position()), camera.screen(deviating.position()), theme.muted, theme.px(1.2f));
  pose_mark(draw, camera, reference, theme.truth, false, theme);
  pose_mark(draw, camera, deviating, theme.orange, true, theme);
  // The distance between two grid lines, as the lens' own scale bar.
  const float bar = float(step * camera.px_per_m);
  const ImVec2 right{camera.high.x - theme.px(8), camera.high.y - theme.px(8)};
  const std::string text = step < 0.9995 ? shown(step, kMillimetres, step < 0.00095 ? (step < 0.000095 ? 2 : 1) : 0)
                                         : shown(step, kMetres, 0);
  const float w = ImGui::CalcTextSize(text.c_str()).x;
  draw.AddRectFilled({right.x - std::max(bar, w) - theme.px(4), right.y - line - theme.px(5)}, camera.high,
                     faded(theme.paper, 0.8f));
  draw.AddLine({right.x - bar, right.y}, right, theme.ink, theme.px(2));
  draw.AddText({std::round(right.x - std::max(0.5f * (bar + w), w)), right.y - line - theme.px(3)}, theme.ink,
               text.c_str());
  draw.PopClipRect();
  draw.AddRect(low, high, theme.ink, theme.px(4), 0, theme.px(1.2f));
  draw.AddLine({low.x, camera.low.y}, {high.x, camera.low.y}, theme.line);
  const std::string gap = shown_length(gap_m);
  std::string title = "lens " + times(magnification);
  if (ImGui::CalcTextSize((title + " " + gap).c_str()).x > high.x - low.x - theme.px(16)) title = times(magnification);
  draw.AddText({low.x + theme.px(8), low.y + theme.px(4)}, theme.ink, title.c_str());
  draw.AddText({high.x - theme.px(8) - ImGui::CalcTextSize(gap.c_str()).x, low.y + theme.px(4)}, theme.orange,
               gap.c_str());
}

}  // namespace odolab::ui
