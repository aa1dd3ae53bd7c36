#include "core/io/picture/bar_picture.h"

#include <algorithm>
#include <cmath>

#include "core/io/picture/axis.h"

namespace odolab {

namespace {

constexpr double kBar_px = 18.0, kPitch_px = 25.0, kGroupGap_px = 12.0, kGroupTitle_px = 24.0;

double width_of(const std::string& text) { return 7.2 * static_cast<double>(text.size()); }

}  // namespace

std::string bar_picture(const BarPicture& picture) {
  double height = 58.0, label_width = 60.0, value_width = 30.0, highest = picture.mark.value_or(0.0);
  for (const BarGroup& group : picture.groups) {
    height += kGroupGap_px + (group.title.empty() ? 0.0 : kGroupTitle_px);
    for (const DrawnBar& bar : group.bars) {
      height += kPitch_px;
      label_width = std::max(label_width, width_of(bar.label));
      value_width = std::max(value_width, width_of(bar.value_text));
      if (std::isfinite(bar.value)) highest = std::max(highest, bar.value);
    }
  }
  const double left = 30.0 + label_width, right = picture.width_px - value_width - 24.0, top = 44.0, bottom = height - 10.0;
  const double least = picture.logarithmic ? std::log10(picture.least) : 0.0;
  const auto scaled = [&](double value) { return picture.logarithmic ? std::log10(std::max(value, picture.least)) : value; };
  const double most = std::max(scaled(highest), least + (picture.logarithmic ? 1.0 : 1e-300));
  const Axis x{least, most, left, right};
  const double whole_height = height + 44.0;

  Svg svg(picture.width_px, whole_height, picture.title);
  svg.text({18.0, 28.0}, picture.title, Anchor::start, 16.0, ink::kText, true);
  svg.rectangle({left, top}, right - left, bottom - top, "#ffffff");
  const double step = picture.logarithmic ? std::max(1.0, round_step(most - least, 8)) : round_step(most - least, 8);
  for (double k = std::ceil(least / step - 1e-9); k * step <= most * (1.0 + 1e-9); k += 1.0) {
    const double at = x.px(k * step);
    svg.line({at, top}, {at, bottom}, {ink::kGrid, 1.0, ""});
    const double value = picture.logarithmic ? std::pow(10.0, k * step) : k * step;
    svg.text({at, bottom + 16.0}, tick_text(value, picture.logarithmic ? value : step), Anchor::middle, 11.0);
  }
  double y = top + kGroupGap_px;
  for (const BarGroup& group : picture.groups) {
    if (!group.title.empty()) {
      svg.text({18.0, y + 13.0}, group.title, Anchor::start, 13.0, ink::kText, true);
      y += kGroupTitle_px;
    }
    for (const DrawnBar& bar : group.bars) {
      svg.text({left - 8.0, y + 13.5}, bar.label, Anchor::end);
      const double end = std::isfinite(bar.value) ? std::max(left + 1.5, x.px(scaled(bar.value))) : left;
      if (std::isfinite(bar.value)) svg.rectangle({left, y}, end - left, kBar_px, bar.colour);
      svg.text({end + 6.0, y + 13.5}, bar.value_text, Anchor::start, 12.0, ink::kText, true);
      y += kPitch_px;
    }
    y += kGroupGap_px;
  }
  if (picture.mark) {
    const double at = x.px(scaled(*picture.mark));
    svg.line({at, top}, {at, bottom}, {ink::kTruth, 1.5, "4 3"});
    svg.text({at, top - 5.0}, picture.mark_label, at > 0.5 * (left + right) ? Anchor::end : Anchor::start, 11.0);
  }
  svg.line({left, top}, {left, bottom}, {ink::kAxis, 1.0, ""});
  svg.text({0.5 * (left + right), bottom + 36.0}, picture.x_label, Anchor::middle);
  return svg.finished();
}

}  // namespace odolab
