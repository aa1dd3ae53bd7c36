#include "ui/look/units.h"

#include <cmath>

#include "core/base/formatted.h"

namespace odolab::ui {

namespace {

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  const std::string text = formatted("%.*f", decimals, std::abs(value));
  // No minus before a number that is written as zero.
  bool zero = true;
  for (const char c : text) zero = zero && (c == '0' || c == '.');
  return value < 0.0 && !zero ? "−" + text : text;
}

// A degree sign stands at its number, other units after a space.
std::string with_unit(const std::string& text, const Unit& unit) {
  const std::string name = unit.name;
  if (name.empty()) return text;
  return name == "°" ? text + name : text + " " + name;
}

}  // namespace

std::string shown(double value_si, const Unit& unit) { return shown(value_si, unit, unit.decimals); }

std::string shown(double value_si, const Unit& unit, int decimals) {
  return with_unit(number(value_si * unit.per_si, decimals), unit);
}

std::string shown_with_error(double value_si, double stderr_si, const Unit& unit, int decimals) {
  if (!(stderr_si > 0.0)) return shown(value_si, unit, decimals);
  return with_unit(number(value_si * unit.per_si, decimals) + " ± " + number(stderr_si * unit.per_si, decimals), unit);
}

std::string shown_length(double metres) {
  const double size = std::abs(metres);
  if (size < 0.00995) return shown(metres, kMillimetres, 2);
  if (size < 0.9995) return shown(metres, kMillimetres, 1);
  return shown(metres, kMetres, 2);
}

std::string clock(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) seconds = 0.0;
  const long hundredths = std::lround(seconds * 100.0);
  const long whole = hundredths / 100;
  if (hundredths >= 360000) return formatted("%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  return formatted("%02ld:%02ld.%02ld", whole / 60, whole % 60, hundredths % 100);
}

std::string times(double factor) { return formatted(factor >= 9.95 ? "×%.0f" : "×%.2g", factor); }

}  // namespace odolab::ui
