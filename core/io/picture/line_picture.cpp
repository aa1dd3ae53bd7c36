#include "core/io/picture/line_picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/io/picture/axis.h"

namespace odolab {

namespace {

// Stretches without gaps; in each column of pixels the first, lowest, highest and last point in their order.
std::vector<std::vector<Point>> stretches(const DrawnLine& line, const Axis& x, const Axis& y) {
  std::vector<std::vector<Point>> result(1);
  std::vector<Point> column;
  const auto close_column = [&] {
    if (column.empty()) return;
    const auto lowest = std::min_element(column.begin(), column.end(), [](Point a, Point b) { return a.y < b.y; });
    const auto highest = std::max_element(column.begin(), column.end(), [](Point a, Point b) { return a.y < b.y; });
    for (auto p = column.begin(); p != column.end(); ++p)
      if (p == column.begin() || p == lowest || p == highest || p + 1 == column.end()) result.back().push_back(*p);
    column.clear();
  };
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!std::isfinite(line.x[i]) || !std::isfinite(line.y[i])) {
      close_column();
      if (!result.back().empty()) result.emplace_back();
      continue;
    }
    const Point p{x.px(line.x[i]), y.px(line.y[i])};
    if (!column.empty() && std::floor(p.x) != std::floor(column.front().x)) close_column();
    column.push_back(p);
  }
  close_column();
  return result;
}

// Dashes would make fur of a noisy signal: here the colours alone tell the lines apart.
// A tint of a line's colour, for what lies under it.
std::string pale(Look look) {
  const std::string colour = stroke_of(look).colour;
  std::string tint = "#";
  for (std::size_t i = 1; i < 7; i += 2) {
    const int value = 255 - (255 - std::stoi(colour.substr(i, 2), nullptr, 16)) / 4;
    tint += "0123456789abcdef"[value / 16];
    tint += "0123456789abcdef"[value % 16];
  }
  return tint;
}

Stroke solid(Look look) { return {stroke_of(look).colour, 1.5, ""}; }

std::vector<Point> outline_of_band(const DrawnBand& band, const Axis& x, const Axis& y) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < band.x.size(); ++i)
    if (std::isfinite(band.x[i]) && std::isfinite(band.high[i]))
      points.push_back({x.px(band.x[i]), y.px(band.high[i])});
  for (std::size_t i = band.x.size(); i-- > 0;)
    if (std::isfinite(band.x[i]) && std::isfinite(band.low[i])) points.push_back({x.px(band.x[i]), y.px(band.low[i])});
  return points;
}

}  // namespace

std::string line_picture(const LinePicture& picture) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double left = 78.0, right = picture.width_px - 20.0, top = 64.0, bottom = picture.height_px - 48.0;
  double low_x = kInfinity, high_x = -kInfinity, low_y = kInfinity, high_y = -kInfinity;
  const auto include = [&](double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
    low_y = std::min(low_y, y);
    high_y = std::max(high_y, y);
  };
  for (const DrawnLine& line : picture.lines) {
    assert(line.x.size() == line.y.size());
    for (std::size_t i = 0; i < line.x.size(); ++i) include(line.x[i], line.y[i]);
  }
  for (const DrawnBand& band : picture.bands) {
    assert(band.x.size() == band.low.size() && band.x.size() == band.high.size());
    for (std::size_t i = 0; i < band.x.size(); ++i) include(band.x[i], band.low[i]), include(band.x[i], band.high[i]);
  }
  Axis x = axis_over(low_x, high_x, left, right);
  if (high_x > low_x) x = {low_x, high_x, left, right};  // time needs no air
  const Axis y = axis_over(low_y, high_y, bottom, top);

  Svg svg(picture.width_px, picture.height_px, picture.title);
  svg.text({18.0, 28.0}, picture.title, Anchor::start, 16.0, ink::kText, true);
  svg.rectangle({left, top}, right - left, bottom - top, "#ffffff");
  svg.begin_clip({left, top}, right - left, bottom - top);
  for (const auto& [from, to] : picture.marked) {  // an instant is to be seen too
    const double width_px = std::max(8.0, x.px(to) - x.px(from)), from_px = 0.5 * (x.px(from) + x.px(to) - width_px);
    svg.rectangle({from_px, top}, width_px, bottom - top, picture.marked_ink);
  }
  for (const DrawnBand& band : picture.bands) svg.polygon(outline_of_band(band, x, y), pale(band.look), {});
  svg.end_clip();
  const double x_step = round_step(x.high - x.low, 10), y_step = round_step(y.high - y.low, 6);
  for (double tick : x.ticks(10)) {
    svg.line({x.px(tick), top}, {x.px(tick), bottom}, {ink::kGrid, 1.0, ""});
    svg.text({x.px(tick), bottom + 17.0}, tick_text(tick, x_step), Anchor::middle, 11.0);
  }
  for (double tick : y.ticks(6)) {
    svg.line({left, y.px(tick)}, {right, y.px(tick)}, {ink::kGrid, 1.0, ""});
    svg.text({left - 6.0, y.px(tick) + 4.0}, tick_text(tick, y_step), Anchor::end, 11.0);
  }
  if (y.low < 0.0 && y.high > 0.0) svg.line({left, y.px(0.0)}, {right, y.px(0.0)}, {ink::kAxis, 1.0, ""});
  svg.begin_clip({left, top}, right - left, bottom - top);
  for (const DrawnLine& line : picture.lines)
    for (const std::vector<Point>& stretch : stretches(line, x, y)) svg.polyline(stretch, solid(line.look));
  svg.end_clip();
  svg.rectangle({left, top}, right - left, bottom - top, "none", {ink::kAxis, 1.0, ""});
  svg.text({0.5 * (left + right), bottom + 36.0}, picture.x_label, Anchor::middle);
  svg.text_upward({18.0, 0.5 * (top + bottom)}, picture.y_label);

  double legend_x = left;
  for (const DrawnLine& line : picture.lines) {
    if (line.label.empty()) continue;
    svg.line({legend_x, 48.0}, {legend_x + 30.0, 48.0}, solid(line.look));
    svg.text({legend_x + 36.0, 52.0}, line.label);
    legend_x += 54.0 + 7.4 * static_cast<double>(line.label.size());
  }
  for (const DrawnBand& band : picture.bands) {
    if (band.label.empty()) continue;
    svg.rectangle({legend_x, 41.0}, 30.0, 14.0, pale(band.look));
    svg.text({legend_x + 36.0, 52.0}, band.label);
    legend_x += 54.0 + 7.4 * static_cast<double>(band.label.size());
  }
  if (!picture.marked.empty() && !picture.marked_label.empty()) {
    svg.rectangle({legend_x, 41.0}, 30.0, 14.0, picture.marked_ink);
    svg.text({legend_x + 36.0, 52.0}, picture.marked_label);
  }
  return svg.finished();
}

}  // namespace odolab
