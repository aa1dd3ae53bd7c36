#include "ui/plot/plot.h"

#include <algorithm>
#include <cmath>

#include "ui/look/widgets.h"
#include "ui/plot/plot_drawing.h"
#include "ui/plot/plot_range.h"

namespace odolab::ui {

namespace {

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

ImVec2 PlotResult::screen_at(double x, double y, const PlotView& view) const {
  return {low.x + float((x - view.x0) / (view.x1 - view.x0)) * (high.x - low.x),
          high.y - float((y - view.y0) / (view.y1 - view.y0)) * (high.y - low.y)};
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
