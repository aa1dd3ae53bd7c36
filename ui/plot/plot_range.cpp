#include "ui/plot/plot_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace odolab::ui {

namespace {

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

}  // namespace

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

PlotView view_of_all(const Plot& what, ImVec2 area) {
  PlotView view;
  fit(what, view, area.x, area.y);
  return view;
}

}  // namespace odolab::ui
