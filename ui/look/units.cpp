#include "ui/look/units.h"

#include <cmath>
#include <cstdio>

namespace odolab::ui {

namespace {

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value));
  // No minus before a number that is written as zero.
  bool zero = true;
  for (const char* c = text; *c; ++c) zero = zero && (*c == '0' || *c == '.');
  return value < 0.0 && !zero ? std::string("−") + text : std::string(text);
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
  char text[48];
  if (hundredths >= 360000) {
    const long whole = hundredths / 100;
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
    return text;
  }
  std::snprintf(text, sizeof text, "%02ld:%02ld.%02ld", hundredths / 6000, hundredths / 100 % 60, hundredths % 100);
  return text;
}

std::string times(double factor) {
  char text[32];
  if (factor >= 9.95)
    std::snprintf(text, sizeof text, "×%.0f", factor);
  else
    std::snprintf(text, sizeof text, "×%.2g", factor);
  return text;
}

}  // namespace odolab::ui
