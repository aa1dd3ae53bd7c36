#include "physics/experiments/concealed/tally.h"

#include <cmath>

#include "core/io/number_text.h"

namespace odolab::concealed {

namespace {

constexpr double kZ = 1.959964;  // 95 % of a normal distribution, both sides

double wilson(const Tally& t, double side) {
  if (t.of == 0) return side < 0.0 ? 0.0 : 1.0;
  const double n = t.of, p = t.share(), z2 = kZ * kZ;
  const double centre = p + 0.5 * z2 / n, half = kZ * std::sqrt(p * (1.0 - p) / n + 0.25 * z2 / (n * n));
  return std::clamp((centre + side * half) / (1.0 + z2 / n), 0.0, 1.0);
}

}  // namespace

double Tally::low() const { return wilson(*this, -1.0); }
double Tally::high() const { return wilson(*this, 1.0); }

std::string text_of(const Tally& t) { return std::to_string(t.hits) + " of " + std::to_string(t.of); }

std::string text_with_interval(const Tally& t) {
  return text_of(t) + number_text(" = %.1f %%", 100.0 * t.share()) + number_text(" (%.1f", 100.0 * t.low()) +
         number_text(" to %.1f)", 100.0 * t.high());
}

std::string percent_of(const Tally& t) { return t.of > 0 ? number_text("%.0f %%", 100.0 * t.share()) : ""; }

}  // namespace odolab::concealed
