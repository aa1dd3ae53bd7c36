// The parts of a plot as they are drawn.
#pragma once

#include <string>

#include "ui/plot/plot.h"

namespace odolab::ui {

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

Margins margins(const Plot& what, ImVec2 size, const Theme& theme);

// `in_order`: its x never falls, so that no more is drawn than there are pixels.
void draw_series(ImDrawList& draw, const PlotSeries& s, const Frame& frame, bool in_order, const Theme& theme);
void draw_area(ImDrawList& draw, const PlotArea& a, const Frame& frame);
void draw_axes(ImDrawList& draw, const Plot& what, const Frame& frame, const Theme& theme, ImVec2 outer_low);
// Beside the y axis' title, at the right end; where there is no room in lines of its own below it.
void draw_legend(ImDrawList& draw, const Plot& what, const Frame& frame, ImVec2 outer, float width, const Theme& theme);

}  // namespace odolab::ui
