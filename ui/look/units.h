// SI inside, the words and units of the workshop on the screen.
#pragma once

#include <string>

namespace odolab::ui {

struct Unit {
  const char* name;  // "mm"
  double per_si;     // shown = SI value * per_si
  int decimals;
  double drag;  // shown units for each pixel of a drag
};

inline constexpr Unit kMillimetres{"mm", 1e3, 1, 0.1};
inline constexpr Unit kMetres{"m", 1.0, 2, 0.01};
inline constexpr Unit kDegrees{"°", 180.0 / 3.14159265358979323846, 2, 0.05};
inline constexpr Unit kSpeed{"m/s", 1.0, 2, 0.005};
inline constexpr Unit kTurnRate{"rad/s", 1.0, 2, 0.01};
inline constexpr Unit kAcceleration{"m/s²", 1.0, 2, 0.005};
inline constexpr Unit kTurnAcceleration{"rad/s²", 1.0, 2, 0.01};
inline constexpr Unit kKilograms{"kg", 1.0, 1, 0.1};
inline constexpr Unit kInertia{"kg m²", 1.0, 2, 0.02};
inline constexpr Unit kSeconds{"s", 1.0, 2, 0.01};
inline constexpr Unit kMilliseconds{"ms", 1e3, 1, 0.1};
inline constexpr Unit kPercent{"%", 100.0, 1, 0.1};
inline constexpr Unit kCoefficient{"", 1.0, 2, 0.005};
inline constexpr Unit kCount{"", 1.0, 0, 1.0};

// "12.3 mm"; a minus sign is a true minus; "–" where the value is not a number.
std::string shown(double value_si, const Unit& unit);
std::string shown(double value_si, const Unit& unit, int decimals);
// "12.3 ± 0.4 mm"; "12.3 mm" where the error is zero, that is: unknown
std::string shown_with_error(double value_si, double stderr_si, const Unit& unit, int decimals);
// A length in the unit that suits its size: "0.43 mm", "12.3 mm", "1.25 m".
std::string shown_length(double metres);
// "00:41.20", "26:54:07"
std::string clock(double seconds);
// "×0.5", "×2", "×50"
std::string times(double factor);

}  // namespace odolab::ui
