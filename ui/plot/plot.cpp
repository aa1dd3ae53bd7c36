#include "ui/plot/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "ui/look/strokes.h"
#include "ui/look/widgets.h"
#include "ui/plot/decimation.h"
#include "ui/plot/ticks.h"

namespace odolab::ui {

namespace {

// The drawing area and what it shows.
struct Frame {
  ImVec2 low, high;
  const PlotView& view;

  float width() const { return high.x - low.x; }
  float height() const { return high.y - low.y; }
  float x(double value) const { return low.x + float((value - view.x0) / (view.x1 - view.x0)) * width(); }
  float y(double value) const { return high.y - float((value - view.y0) / (view.y1 - view.y0)) * height(); }
  double x_of(float at) const { return view.x0 + double(at - low.x) / width() * (view.x1 - view.x0); }
  double y_of(float at) const { return view.y0 + double(high.y - at) / height() * (view.y1 - view.y0); }
};

// Of a plot around its drawing area, for numbers, titles and legend.
struct Margins {
  float left, top, right, bottom;
};

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

Margins margins(const Plot& what, ImVec2 size, const Theme& theme) {
  const float line = ImGui::GetTextLineHeight();
  return {theme.px(52), line * float(1 + legend_lines(what, size.x, theme)) + theme.px(6), theme.px(8),
          line + theme.px(5)};
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWidestArea = 3.0;  // times the height of the curves, on either side

struct Range {
  double low = kInfinity;
  double high = -kInfinity;

  void take(double v) {
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  bool empty() const { return !(low <= high); }
};

// The view in which all data is in sight with a little air around.
void fit(const Plot& what, PlotView& view, float width, float height) {
  Range x, y;
  for (const PlotSeries& s : what.series)
    if (s.fits)
      for (std::size_t i = 0; i < s.count; ++i) {
        x.take(s.x[i]);
        y.take(s.y[i]);
      }
  // An uncertainty far wider than what it belongs to fills the plot and does not flatten its curve.
  const double wide = y.empty() || !(y.high > y.low) ? kInfinity : kWidestArea * (y.high - y.low);
  const double lowest = y.empty() ? -kInfinity : y.low - wide, highest = y.empty() ? kInfinity : y.high + wide;
  for (const PlotArea& a : what.areas)
    for (std::size_t i = 0; i < a.count; ++i) {
      x.take(a.x[i]);
      y.take(std::max(a.low[i], lowest));
      y.take(std::min(a.high[i], highest));
    }
  if (what.equal_scale) {
    if (x.empty()) x = y = {-0.1, 0.1};
    x.take(0.0);
    y.take(0.0);
  }
  if (what.from_zero) y.take(0.0);
  if (x.empty()) x = {0.0, 1.0};
  if (y.empty()) y = {0.0, std::max(what.least_y_span, 1e-3)};
  if (y.high - y.low < what.least_y_span) {
    if (what.from_zero)
      y.high = y.low + what.least_y_span;
    else {
      const double middle = 0.5 * (y.low + y.high);
      y = {middle - 0.5 * what.least_y_span, middle + 0.5 * what.least_y_span};
    }
  }
  if (what.x_low) x.low = *what.x_low;
  if (what.x_high) x.high = *what.x_high;
  if (!(x.high > x.low)) x.high = x.low + 1.0;
  if (!(y.high > y.low)) y.high = y.low + 1e-3;
  const double air = 0.08 * (y.high - y.low);
  view.y0 = what.from_zero ? y.low : y.low - air;
  view.y1 = y.high + 1.6 * air;
  view.x0 = x.low;
  view.x1 = x.high;
  if (!what.equal_scale) return;
  const double side_air = 0.08 * (x.high - x.low);
  view.x0 -= side_air;
  view.x1 += side_air;
  const double per_px = std::max((view.x1 - view.x0) / width, (view.y1 - view.y0) / height);
  const double mx = 0.5 * (view.x0 + view.x1), my = 0.5 * (view.y0 + view.y1);
  view.x0 = mx - 0.5 * per_px * width;
  view.x1 = mx + 0.5 * per_px * width;
  view.y0 = my - 0.5 * per_px * height;
  view.y1 = my + 0.5 * per_px * height;
}

constexpr double kWidest = 20.0;  // times what fits

void zoom(PlotView& view, double about_x, double about_y, double factor, bool both) {
  view.x0 = about_x + (view.x0 - about_x) * factor;
  view.x1 = about_x + (view.x1 - about_x) * factor;
  if (both) {
    view.y0 = about_y + (view.y0 - about_y) * factor;
    view.y1 = about_y + (view.y1 - about_y) * factor;
  }
  view.fitted = false;
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

void draw_axes(ImDrawList& draw, const Plot& what, const Frame& frame, const Theme& theme, ImVec2 outer_low) {
  const float line_height = ImGui::GetTextLineHeight();
  const double sx = what.x.unit.per_si, sy = what.y.unit.per_si;
  const int most_x = std::max(2, int(frame.width() / theme.px(80))),
            most_y = std::max(4, int(frame.height() / theme.px(36)));
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

// Beside the y axis' title, at the right end; where there is no room in lines of its own below it.
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

std::string read_out(const Plot& what, const Frame& frame, ImVec2 mouse) {
  const auto with_unit = [](const PlotAxis& axis, double v) { return shown(v, axis.unit, axis.unit.decimals); };
  if (what.equal_scale)
    return what.x.label + " " + with_unit(what.x, frame.x_of(mouse.x)) + "\n" + what.y.label + " " +
           with_unit(what.y, frame.y_of(mouse.y));
  const double x = frame.x_of(mouse.x);
  std::string text = with_unit(what.x, x);
  for (const PlotSeries& s : what.series) {
    if (s.label.empty() || s.count == 0 || s.stroke == Stroke::none || x < s.x[0] || x > s.x[s.count - 1]) continue;
    const std::size_t after = std::size_t(std::lower_bound(s.x, s.x + s.count, x) - s.x);
    const std::size_t i = after > 0 && (after == s.count || x - s.x[after - 1] < s.x[after] - x) ? after - 1 : after;
    text += "\n" + s.label + "  " + with_unit(what.y, s.y[i]);
  }
  for (const PlotMark& m : what.marks)
    if (std::abs(frame.x(m.x) - mouse.x) < 5.0f) text += "\n" + m.label;
  return text;
}

}  // namespace

double PlotResult::x_at(float screen_x, const PlotView& view) const {
  return view.x0 + double(screen_x - low.x) / (high.x - low.x) * (view.x1 - view.x0);
}

ImVec2 PlotResult::screen_at(double x, double y, const PlotView& view) const {
  return {low.x + float((x - view.x0) / (view.x1 - view.x0)) * (high.x - low.x),
          high.y - float((y - view.y0) / (view.y1 - view.y0)) * (high.y - low.y)};
}

ImVec2 drawing_area(const Plot& what, ImVec2 size, const Theme& theme) {
  const Margins m = margins(what, size, theme);
  return {std::max(size.x - m.left - m.right, 20.0f), std::max(size.y - m.top - m.bottom, 10.0f)};
}

PlotView view_of_all(const Plot& what, ImVec2 area) {
  PlotView view;
  fit(what, view, area.x, area.y);
  return view;
}

PlotResult plot(const char* id, ImVec2 size, const Plot& what, PlotView& view, const Theme& theme) {
  const ImVec2 outer = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(id, size);
  const ImGuiIO& io = ImGui::GetIO();
  const Margins m = margins(what, size, theme);
  const ImVec2 area = drawing_area(what, size, theme);
  PlotResult result{{outer.x + m.left, outer.y + m.top},
                    {outer.x + m.left + area.x, outer.y + m.top + area.y},
                    false,
                    std::nullopt,
                    std::nullopt};
  const Frame frame{result.low, result.high, view};
  if (view.fitted) fit(what, view, frame.width(), frame.height());

  const ImVec2 mouse = io.MousePos;
  const bool inside =
      mouse.x >= result.low.x && mouse.x <= result.high.x && mouse.y >= result.low.y && mouse.y <= result.high.y;
  result.hovered = ImGui::IsItemHovered() && inside;
  if (result.hovered && io.MouseWheel != 0.0f) {
    zoom(view, frame.x_of(mouse.x), frame.y_of(mouse.y), std::pow(0.85, double(io.MouseWheel)),
         what.equal_scale || io.KeyShift);
    PlotView whole;
    fit(what, whole, frame.width(), frame.height());
    const double most = what.equal_scale ? kWidest : 1.0;  // beyond all of its data there is nothing to see
    if (view.x1 - view.x0 > most * (whole.x1 - whole.x0)) view = whole;
  }
  if (result.hovered && ImGui::IsMouseDoubleClicked(0)) {
    view.fitted = true;
    view.drag_from.reset();
  } else if (ImGui::IsItemActivated() && inside) {
    view.drag_from = mouse;
  }
  const float enough = theme.px(5);
  bool selecting = false;
  if (view.drag_from) {
    const ImVec2 from = *view.drag_from;
    const bool wide = std::abs(mouse.x - from.x) > enough, tall = std::abs(mouse.y - from.y) > enough;
    selecting = what.equal_scale ? wide || tall : wide;
    if (what.equal_scale &&
        selecting) {  // a drag moves such a plot, for a box of another shape would not keep its scale
      const double dx = frame.x_of(mouse.x - io.MouseDelta.x) - frame.x_of(mouse.x);
      const double dy = frame.y_of(mouse.y - io.MouseDelta.y) - frame.y_of(mouse.y);
      view.x0 += dx;
      view.x1 += dx;
      view.y0 += dy;
      view.y1 += dy;
      view.fitted = false;
    }
    if (!ImGui::IsItemActive()) {
      if (!selecting && inside) result.clicked_x = frame.x_of(from.x);
      if (selecting && !what.equal_scale) {
        const double a = frame.x_of(std::max(result.low.x, std::min(from.x, mouse.x)));
        const double b = frame.x_of(std::min(result.high.x, std::max(from.x, mouse.x)));
        if (what.brushes) {
          result.brushed = {a, b};
        } else {
          view.x0 = a;
          view.x1 = std::max(b, a + 1e-9);
          view.fitted = false;
        }
      }
      view.drag_from.reset();
    }
  }

  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(result.low, result.high, theme.paper);
  draw_axes(draw, what, frame, theme, outer);
  draw.PushClipRect(result.low, result.high, true);
  bool any = false;
  for (const PlotBand& b : what.bands)
    draw.AddRectFilled({std::max(frame.x(b.from) - 0.5f, result.low.x), result.low.y},
                       {std::min(std::max(frame.x(b.to), frame.x(b.from) + theme.px(2)), result.high.x), result.high.y},
                       b.colour);
  for (const PlotArea& a : what.areas) draw_area(draw, a, frame);
  for (const PlotMark& m : what.marks) {
    const float x = std::round(frame.x(m.x));
    draw.AddLine({x, result.low.y}, {x, result.high.y}, faded(m.colour, 0.55f), theme.px(1));
    draw.AddTriangleFilled({x - theme.px(4), result.low.y}, {x + theme.px(4), result.low.y},
                           {x, result.low.y + theme.px(6)}, m.colour);
  }
  for (const PlotSeries& s : what.series) {
    any = any || s.count > 0;
    draw_series(draw, s, frame, !what.equal_scale, theme);
  }
  if (what.cursor_x) {
    const float x = std::round(frame.x(*what.cursor_x));
    draw.AddLine({x, result.low.y}, {x, result.high.y}, theme.ink, theme.px(1));
  }
  if (selecting && !what.equal_scale)
    draw.AddRectFilled({std::min(view.drag_from ? view.drag_from->x : mouse.x, mouse.x), result.low.y},
                       {std::max(view.drag_from ? view.drag_from->x : mouse.x, mouse.x), result.high.y},
                       faded(theme.sky, 0.25f));
  draw.PopClipRect();
  draw.AddRect(result.low, result.high, theme.line);
  if (what.legend) draw_legend(draw, what, frame, outer, size.x, theme);
  if (!any && !what.empty_text.empty()) {
    const std::string words = wrapped_at(what.empty_text, result.high.x - result.low.x - theme.px(24));
    const ImVec2 text = ImGui::CalcTextSize(words.c_str());
    const ImVec2 at{std::round(0.5f * (result.low.x + result.high.x - text.x)),
                    std::round(result.low.y + 0.42f * (result.high.y - result.low.y) - 0.5f * text.y)};
    draw.AddRectFilled({at.x - theme.px(8), at.y - theme.px(4)},
                       {at.x + text.x + theme.px(8), at.y + text.y + theme.px(4)}, theme.paper);
    draw.AddText(at, theme.muted, words.c_str());
  }
  if (result.hovered && any && !selecting && !ImGui::IsMouseDown(0)) {
    draw.AddLine({mouse.x, result.low.y}, {mouse.x, result.high.y}, faded(theme.muted, 0.5f), 1.0f);
    if (what.equal_scale)
      draw.AddLine({result.low.x, mouse.y}, {result.high.x, mouse.y}, faded(theme.muted, 0.5f), 1.0f);
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(read_out(what, frame, mouse).c_str());
    ImGui::EndTooltip();
  }
  return result;
}

}  // namespace odolab::ui
