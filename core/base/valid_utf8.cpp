#include "core/base/valid_utf8.h"

#include <cstddef>

namespace odolab {

namespace {

struct Letter {
  std::size_t bytes;
  bool valid;  // else `bytes` are those that no letter goes on from
};

// The first letter of a text that is not empty, by table 3-7 of the Unicode standard.
Letter first_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {1, true};
  if (first < 0xC2 || first > 0xF4) return {1, false};
  const std::size_t bytes = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  // of the second byte: no longer form than needed, no surrogates, nothing beyond U+10FFFF
  unsigned char low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  unsigned char high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  for (std::size_t i = 1; i < bytes; ++i) {
    if (i == text.size() || byte(i) < low || byte(i) > high) return {i, false};
    low = 0x80, high = 0xBF;
  }
  return {bytes, true};
}

}  // namespace

std::string valid_utf8(std::string_view text) {
  std::string valid;
  valid.reserve(text.size());
  while (!text.empty()) {
    const Letter letter = first_letter(text);
    valid += letter.valid ? text.substr(0, letter.bytes) : std::string_view("\xEF\xBF\xBD");
    text.remove_prefix(letter.bytes);
  }
  return valid;
}

}  // namespace odolab
