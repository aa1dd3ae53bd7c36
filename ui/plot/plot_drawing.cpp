#include "ui/plot/plot_drawing.h"

#include <algorithm>
#include <cmath>

#include "ui/look/strokes.h"
#include "ui/plot/decimation.h"
#include "ui/plot/ticks.h"

namespace odolab::ui {

namespace {

std::string axis_title(const PlotAxis& axis) {
  const std::string unit = axis.unit.name;
  return unit.empty() ? axis.label : axis.label.empty() ? unit : axis.label + " (" + unit + ")";
}

float legend_entry_width(const PlotSeries& s, const Theme& theme) {
  return theme.px(20) + theme.px(5) + ImGui::CalcTextSize(s.label.c_str()).x + theme.px(14);
}

// The lines that a legend takes below that of the y axis' title: none where it stands beside the title.
int legend_lines(const Plot& what, float width, const Theme& theme) {
  float total = 0.0f, x = 0.0f;
  int lines = 1;
  for (const PlotSeries& s : what.series) {
    if (s.label.empty()) continue;
    const float entry = legend_entry_width(s, theme);
    if (x > 0.0f && x + entry > width) {
      ++lines;
      x = 0.0f;
    }
    x += entry;
    total += entry;
  }
  const float title = ImGui::CalcTextSize(axis_title(what.y).c_str()).x;
  return !what.legend || total == 0.0f || title + total < width ? 0 : lines;
}

void marker(ImDrawList& draw, Marker kind, ImVec2 at, ImU32 colour, const Theme& theme) {
  const float r = theme.px(4.5f), thin = theme.px(1.6f);
  switch (kind) {
    case Marker::none:
      break;
    case Marker::disc:
      draw.AddCircleFilled(at, r, colour);
      draw.AddCircle(at, r, theme.paper, 0, theme.px(1));
      break;
    case Marker::ring:
      draw.AddCircle(at, r, colour, 0, thin);
      break;
    case Marker::square:
      draw.AddRectFilled({at.x - r, at.y - r}, {at.x + r, at.y + r}, colour);
      draw.AddRect({at.x - r, at.y - r}, {at.x + r, at.y + r}, theme.paper, 0, 0, theme.px(1));
      break;
    case Marker::box:
      draw.AddRect({at.x - r, at.y - r}, {at.x + r, at.y + r}, colour, 0, 0, thin);
      break;
    case Marker::cross: {
      const float l = theme.px(9);
      draw.AddLine({at.x - l, at.y}, {at.x + l, at.y}, colour, theme.px(2));
      draw.AddLine({at.x, at.y - l}, {at.x, at.y + l}, colour, theme.px(2));
      break;
    }
  }
}

// A line of one of the strokes; in a legend a short piece of it.
void stroke_line(ImDrawList& draw, const std::vector<ImVec2>& points, Stroke stroke, ImU32 colour, float width,
                 const Theme& theme) {
  if (stroke == Stroke::line) solid_line(draw, points, colour, width);
  if (stroke == Stroke::dashed) dashed_line(draw, points, colour, width, theme.px(6), theme.px(4));
  if (stroke == Stroke::dotted) dashed_line(draw, points, colour, 1.2f * width, theme.px(2), theme.px(4));
  if (stroke == Stroke::long_dashed) dashed_line(draw, points, colour, width, theme.px(14), theme.px(4));
}

// Round, and as close as it takes for two numbers to stand on the axis, if there is room for them.
double step_with_two_numbers(double low, double high, int most, float height) {
  const double span = high - low, closest = 1.2 * double(ImGui::GetTextLineHeight()) / double(height) * span;
  double step = round_step(span, most);
  for (int more = most + 1; more < 4 * most && ticks_every(step, low, high).size() < 3; ++more) {
    const double closer = round_step(span, more);
    if (closer < closest) break;
    step = closer;
  }
  return step;
}

}  // namespace

Margins margins(const Plot& what, ImVec2 size, const Theme& theme) {
  const float line = ImGui::GetTextLineHeight();
  return {theme.px(52), line * float(1 + legend_lines(what, size.x, theme)) + theme.px(6), theme.px(8),
          line + theme.px(5)};
}

ImVec2 drawing_area(const Plot& what, ImVec2 size, const Theme& theme) {
  const Margins m = margins(what, size, theme);
  return {std::max(size.x - m.left - m.right, 20.0f), std::max(size.y - m.top - m.bottom, 10.0f)};
}

void draw_series(ImDrawList& draw, const PlotSeries& s, const Frame& frame, bool in_order, const Theme& theme) {
  if (s.stroke != Stroke::none) {
    std::vector<std::size_t> kept;
    if (in_order)
      kept = decimated(s.x, s.y, s.count, frame.view.x0, frame.view.x1, std::max(1, int(frame.width())));
    else
      for (std::size_t i = 0; i < s.count; ++i) kept.push_back(i);
    std::vector<ImVec2> points;
    const auto finish = [&] {
      stroke_line(draw, points, s.stroke, s.colour, theme.px(s.width), theme);
      points.clear();
    };
    for (const std::size_t i : kept) {
      if (!std::isfinite(s.y[i]) || !std::isfinite(s.x[i])) {
        finish();
        continue;
      }
      points.push_back({frame.x(s.x[i]), frame.y(s.y[i])});
    }
    finish();
  }
  if (s.marker != Marker::none)
    for (std::size_t i = 0; i < s.count; ++i)
      marker(draw, s.marker, {frame.x(s.x[i]), frame.y(s.y[i])}, s.colour, theme);
}

void draw_area(ImDrawList& draw, const PlotArea& a, const Frame& frame) {
  const ImDrawListFlags flags = draw.Flags;
  draw.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // else seams show between the pieces
  for (std::size_t i = 1; i < a.count; ++i)
    draw.AddQuadFilled({frame.x(a.x[i - 1]), frame.y(a.low[i - 1])}, {frame.x(a.x[i]), frame.y(a.low[i])},
                       {frame.x(a.x[i]), frame.y(a.high[i])}, {frame.x(a.x[i - 1]), frame.y(a.high[i - 1])}, a.colour);
  draw.Flags = flags;
}

void draw_axes(ImDrawList& draw, const Plot& what, const Frame& frame, const Theme& theme, ImVec2 outer_low) {
  const float line_height = ImGui::GetTextLineHeight();
  const double sx = what.x.unit.per_si, sy = what.y.unit.per_si;
  // Four numbers along y where they have room, however low the plot.
  const int with_room = std::max(1, int(frame.height() / (1.2f * line_height)));
  const int most_x = std::max(2, int(frame.width() / theme.px(80))),
            most_y = std::max(std::min(4, with_room), int(frame.height() / theme.px(36)));
  double step_x = round_step((frame.view.x1 - frame.view.x0) * sx, most_x);
  double step_y = step_with_two_numbers(frame.view.y0 * sy, frame.view.y1 * sy, most_y, frame.height());
  if (what.equal_scale && sx == sy) {  // the same marks on both, as close as the numbers along x allow
    const double near = std::min(step_x, step_y), px_per_unit = frame.width() / ((frame.view.x1 - frame.view.x0) * sx);
    step_x = step_y = near * px_per_unit > theme.px(46) ? near : std::max(step_x, step_y);
  }
  const float title_width = ImGui::CalcTextSize(axis_title(what.x).c_str()).x;
  for (const double v : ticks_every(step_x, frame.view.x0 * sx, frame.view.x1 * sx)) {
    const float x = std::round(frame.x(v / sx));
    const bool zero = what.equal_scale && v == 0.0;
    draw.AddLine({x, frame.low.y}, {x, frame.high.y}, zero ? theme.muted : theme.faint, 1.0f);
    const std::string text = tick_text(v, step_x);
    const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
    // The axis title stands at the right end of the same line.
    if (x + half < frame.high.x - title_width - theme.px(10))
      draw.AddText({std::round(x - half), frame.high.y + theme.px(3)}, theme.muted, text.c_str());
  }
  draw.AddText({std::round(frame.high.x - title_width), frame.high.y + theme.px(3)}, theme.muted,
               axis_title(what.x).c_str());
  for (const double v : ticks_every(step_y, frame.view.y0 * sy, frame.view.y1 * sy)) {
    const float y = std::round(frame.y(v / sy));
    const bool zero = what.equal_scale && v == 0.0;
    draw.AddLine({frame.low.x, y}, {frame.high.x, y}, zero ? theme.muted : theme.faint, 1.0f);
    const std::string text = tick_text(v, step_y);
    const float w = ImGui::CalcTextSize(text.c_str()).x;
    if (y - 0.5f * line_height >= frame.low.y - theme.px(4))
      draw.AddText({frame.low.x - w - theme.px(6), std::round(y - 0.5f * line_height)}, theme.muted, text.c_str());
  }
  draw.AddText({outer_low.x + theme.px(2), outer_low.y}, theme.muted, axis_title(what.y).c_str());
}

void draw_legend(ImDrawList& draw, const Plot& what, const Frame& frame, ImVec2 outer, float width,
                 const Theme& theme) {
  const float swatch = theme.px(20), gap = theme.px(14), line = ImGui::GetTextLineHeight();
  const bool beside = legend_lines(what, width, theme) == 0;
  float total = 0.0f;
  for (const PlotSeries& s : what.series)
    if (!s.label.empty()) total += legend_entry_width(s, theme);
  float x = beside ? frame.high.x - total + gap : outer.x, top = beside ? outer.y : outer.y + line;
  for (const PlotSeries& s : what.series) {
    if (s.label.empty()) continue;
    const float entry = legend_entry_width(s, theme);
    if (!beside && x > outer.x && x + entry > outer.x + width) {
      x = outer.x;
      top += line;
    }
    const float middle = top + 0.5f * line;
    stroke_line(draw, {{x, middle}, {x + swatch, middle}}, s.stroke, s.colour, theme.px(2), theme);
    marker(draw, s.marker, {x + 0.5f * swatch, middle}, s.colour, theme);
    draw.AddText({x + swatch + theme.px(5), top}, theme.ink, s.label.c_str());
    x += entry;
  }
}

}  // namespace odolab::ui
