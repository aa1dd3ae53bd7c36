// How many letters a text of UTF-8 has: the bytes that go on a letter take no place of their own.
#pragma once

#include <algorithm>
#include <string_view>

namespace odolab {

inline int letters_of(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace odolab
