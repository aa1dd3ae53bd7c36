#include "core/io/window_words.h"

#include "core/io/number_text.h"

namespace odolab {

namespace {

std::string size_of(double value) { return number_text(value < 9.95 ? "%.1f" : "%.0f", value); }

}  // namespace

std::string over_which_way(const WindowSize& window) {
  if (!window.is_long()) return "over each metre or radian";
  return "from one pose of the truth to the next, " + size_of(window.way_m) + " m and " + size_of(window.turn_rad) +
         " rad in the median";
}

}  // namespace odolab
