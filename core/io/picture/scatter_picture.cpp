#include "core/io/picture/scatter_picture.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/io/picture/axis.h"
#include "core/io/picture/svg.h"

namespace odolab {

namespace {

constexpr double kMm = 1000.0;

struct Cloud {
  std::string label;
  const std::vector<ReturnError>* errors;
  bool clockwise;
  bool filled;

  std::string colour() const { return clockwise ? ink::kOrange : ink::kBlue; }
};

Point mean_mm(const std::vector<ReturnError>& errors) {
  Point sum;
  for (const ReturnError& e : errors) sum = {sum.x + kMm * e.x_m, sum.y + kMm * e.y_m};
  const double n = static_cast<double>(errors.size());
  return {sum.x / n, sum.y / n};
}

// Discs and squares, open before and filled after, as in the window.
void draw_mark(Svg& svg, Point at, const Cloud& cloud) {
  constexpr double kReach = 4.5;
  const std::string fill = cloud.filled ? cloud.colour() : "none";
  const Stroke edge{cloud.filled ? "#ffffff" : cloud.colour(), cloud.filled ? 1.0 : 1.8, ""};
  if (cloud.clockwise)
    svg.circle(at, kReach, fill, edge);
  else
    svg.rectangle({at.x - kReach, at.y - kReach}, 2.0 * kReach, 2.0 * kReach, fill, edge);
}

void draw_centre(Svg& svg, Point at) {
  constexpr double kReach = 9.0;
  svg.line({at.x - kReach, at.y}, {at.x + kReach, at.y}, {ink::kTruth, 2.0, ""});
  svg.line({at.x, at.y - kReach}, {at.x, at.y + kReach}, {ink::kTruth, 2.0, ""});
}

}  // namespace

std::string scatter_picture(const ScatterPicture& picture) {
  const double left = 66.0, right = picture.width_px - 20.0, top = 46.0, bottom = picture.height_px - 104.0;
  std::vector<Cloud> clouds;
  const std::size_t n = picture.experiments.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && i + 1 < n) continue;
    const DrawnUmbmark& e = picture.experiments[i];
    const std::string end = e.label.empty() ? "" : ", " + e.label;
    const bool filled = i + 1 == n;
    if (!e.runs.clockwise.empty()) clouds.push_back({"cw" + end, &e.runs.clockwise, true, filled});
    if (!e.runs.counter_clockwise.empty()) clouds.push_back({"ccw" + end, &e.runs.counter_clockwise, false, filled});
  }

  double low_x = 0.0, high_x = 0.0, low_y = 0.0, high_y = 0.0;  // the origin, no error at all, is always in sight
  for (const Cloud& cloud : clouds)
    for (const ReturnError& e : *cloud.errors) {
      low_x = std::min(low_x, kMm * e.x_m);
      high_x = std::max(high_x, kMm * e.x_m);
      low_y = std::min(low_y, kMm * e.y_m);
      high_y = std::max(high_y, kMm * e.y_m);
    }
  const double mm_per_px =
      1.16 * std::max({(high_x - low_x) / (right - left), (high_y - low_y) / (bottom - top), 0.01});
  const double middle_x = 0.5 * (low_x + high_x), middle_y = 0.5 * (low_y + high_y);
  const double half_x = 0.5 * (right - left) * mm_per_px, half_y = 0.5 * (bottom - top) * mm_per_px;
  const Axis x{middle_x - half_x, middle_x + half_x, left, right};
  const Axis y{middle_y - half_y, middle_y + half_y, bottom, top};
  const auto at = [&](double x_mm, double y_mm) { return Point{x.px(x_mm), y.px(y_mm)}; };

  Svg svg(picture.width_px, picture.height_px, picture.title);
  svg.text({18.0, 28.0}, picture.title, Anchor::start, 16.0, ink::kText, true);
  svg.rectangle({left, top}, right - left, bottom - top, "#ffffff", {ink::kAxis, 1.0, ""});
  const double step = round_step(2.0 * half_x, 7);
  for (double k = std::ceil(x.low / step); k * step <= x.high; k += 1.0) {
    svg.line({x.px(k * step), top}, {x.px(k * step), bottom}, {ink::kGrid, 1.0, ""});
    svg.text({x.px(k * step), bottom + 17.0}, tick_text(k * step, step), Anchor::middle, 11.0);
  }
  for (double k = std::ceil(y.low / step); k * step <= y.high; k += 1.0) {
    svg.line({left, y.px(k * step)}, {right, y.px(k * step)}, {ink::kGrid, 1.0, ""});
    svg.text({left - 6.0, y.px(k * step) + 4.0}, tick_text(k * step, step), Anchor::end, 11.0);
  }
  svg.line(at(x.low, 0.0), at(x.high, 0.0), {ink::kAxis, 1.2, ""});
  svg.line(at(0.0, y.low), at(0.0, y.high), {ink::kAxis, 1.2, ""});
  svg.text({0.5 * (left + right), bottom + 36.0}, "return error in x [mm]", Anchor::middle);
  svg.text_upward({18.0, 0.5 * (top + bottom)}, "return error in y [mm]");

  for (const Cloud& cloud : clouds) {
    const Point centre = mean_mm(*cloud.errors);
    svg.line(at(0.0, 0.0), at(centre.x, centre.y), {cloud.colour(), 1.4, "5 3"});
  }
  for (const Cloud& cloud : clouds)
    for (const ReturnError& e : *cloud.errors) draw_mark(svg, at(kMm * e.x_m, kMm * e.y_m), cloud);
  for (const Cloud& cloud : clouds) {
    const Point centre = mean_mm(*cloud.errors);
    draw_centre(svg, at(centre.x, centre.y));
  }

  double legend_y = picture.height_px - 48.0;
  double legend_x = left;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Point centre = mean_mm(*clouds[i].errors);
    const std::string text = formatted("%s: %.0f mm", clouds[i].label.c_str(), std::hypot(centre.x, centre.y));
    draw_mark(svg, {legend_x + 6.0, legend_y - 4.0}, clouds[i]);
    svg.text({legend_x + 20.0, legend_y}, text);
    legend_x += 0.5 * (right - left);
    if (i % 2 == 1) legend_x = left, legend_y += 22.0;
  }
  return svg.finished();
}

}  // namespace odolab
