// The one plot of the window: axes with units and round ticks, legend, read-out, zoom by wheel and drag, double click
// fits.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ui/look/theme.h"
#include "ui/look/units.h"

namespace odolab::ui {

enum class Stroke { line, dashed, dotted, long_dashed, none };
enum class Marker { none, disc, ring, square, box, cross };

// One curve or cloud. The numbers belong to the caller and outlive the call; they are SI.
struct PlotSeries {
  std::string label;  // empty: not in the legend
  const double* x = nullptr;
  const double* y = nullptr;
  std::size_t count = 0;
  ImU32 colour = 0;
  Stroke stroke = Stroke::line;
  Marker marker = Marker::none;
  float width = 1.6f;
  bool fits = true;  // counts for the range of the axes
};

// A vertical line at an event.
struct PlotMark {
  double x = 0.0;
  std::string label;
  ImU32 colour = 0;
};

// A stretch of the x axis.
struct PlotBand {
  double from = 0.0, to = 0.0;
  ImU32 colour = 0;  // faded by the caller
};

// The area between two curves.
struct PlotArea {
  const double* x = nullptr;
  const double* low = nullptr;
  const double* high = nullptr;
  std::size_t count = 0;
  ImU32 colour = 0;
};

struct PlotAxis {
  std::string label;
  Unit unit = kCoefficient;
};

struct Plot {
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<PlotMark> marks;
  std::vector<PlotBand> bands;          // behind everything
  std::vector<PlotArea> areas;          // behind the curves; they count for the range of the axes up to a few times it
  bool brushes = false;                 // a drag chooses a stretch instead of zooming into it
  std::optional<double> cursor_x;       // e.g. the time that is shown
  std::optional<double> x_low, x_high;  // instead of the data's range where the plot is fitted
  bool equal_scale = false;             // one unit of x is as long as one of y; the origin is in sight
  bool from_zero = false;               // y begins at zero
  bool legend = true;
  double least_y_span = 0.0;  // the plot never shows less than this much of y when fitted, so that noise stays small
  std::string empty_text;     // shown while there is nothing to draw
};

// What is looked at; the caller keeps it. SI.
struct PlotView {
  bool fitted = true;
  double x0 = 0.0, x1 = 1.0, y0 = 0.0, y1 = 1.0;
  std::optional<ImVec2> drag_from;  // screen
};

struct PlotResult {
  ImVec2 low, high;  // the drawing area inside the axes, on the screen
  bool hovered = false;
  std::optional<double> clicked_x;                                  // where a click without a drag landed
  std::optional<std::pair<double, double>> brushed = std::nullopt;  // once a person has let go
  ImVec2 screen_at(double x, double y, const PlotView& view) const;
};

// What is left for the drawing inside the axes of a plot of this size.
ImVec2 drawing_area(const Plot& what, ImVec2 size, const Theme& theme);
// What a fitted plot shows in a drawing area of this size.
PlotView view_of_all(const Plot& what, ImVec2 area);

PlotResult plot(const char* id, ImVec2 size, const Plot& what, PlotView& view, const Theme& theme);

}  // namespace odolab::ui
