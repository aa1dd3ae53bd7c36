#include "ui/plot/ticks.h"

#include <algorithm>
#include <cmath>

#include "ui/look/units.h"

namespace odolab::ui {

double round_step(double span, int most) {
  const double least = span / std::max(1, most);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

std::vector<double> round_ticks(double low, double high, int most) {
  if (!(high > low) || !std::isfinite(high - low)) return {};
  return ticks_every(round_step(high - low, most), low, high);
}

std::vector<double> ticks_every(double step, double low, double high) {
  std::vector<double> ticks;
  if (!(high > low) || !std::isfinite(high - low)) return ticks;
  if ((high - low) / step > 1000.0) return ticks;  // no axis has room for so many
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  for (double k = first; k <= last; k += 1.0) ticks.push_back(k * step);
  return ticks;
}

std::string tick_text(double value, double step) {
  const int decimals = step >= 1.0 ? 0 : int(std::ceil(-std::log10(step) - 1e-9));
  return shown(value, {"", 1.0, decimals, 0.0});
}

}  // namespace odolab::ui
