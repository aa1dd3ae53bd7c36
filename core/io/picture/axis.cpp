#include "core/io/picture/axis.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"

namespace odolab {

double round_step(double range, int wanted) {
  if (!(range > 0.0) || !std::isfinite(range)) return 1.0;
  const double rough = range / std::max(1, wanted);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * 0.999) return factor * power;
  return 10.0 * power;
}

std::vector<double> Axis::ticks(int wanted) const {
  const double step = round_step(high - low, wanted);
  std::vector<double> result;
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  for (double k = first; k <= last && result.size() < 200; k += 1.0) result.push_back(k * step);
  return result;
}

Axis axis_over(double low, double high, double low_px, double high_px) {
  if (!(low <= high) || !std::isfinite(low) || !std::isfinite(high)) low = 0.0, high = 1.0;
  double air = 0.06 * (high - low);
  if (!(air > 1e-12 * (std::abs(low) + std::abs(high)))) air = std::max(0.5, 0.1 * std::abs(low));
  return {low - air, high + air, low_px, high_px};
}

std::string tick_text(double value, double step) {
  if (std::abs(value) < 1e-9 * step) value = 0.0;
  std::string result;
  if (step >= 1e6 || step < 1e-5) {
    result = formatted("%.3g", value);
  } else {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    result = formatted("%.*f", decimals, value);
  }
  if (result[0] == '-') result.replace(0, 1, "\xE2\x88\x92");
  return result;
}

}  // namespace odolab
