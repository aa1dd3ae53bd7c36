// Numbers in a sentence.
#pragma once

#include <cstdio>
#include <string>

namespace odolab {

// As printf; up to 511 characters.
template <typename... Numbers>
std::string formatted(const char* format, Numbers... numbers) {
  char text[512];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

}  // namespace odolab
