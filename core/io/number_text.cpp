#include "core/io/number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

#include "core/base/formatted.h"
#include "core/base/valid_utf8.h"

namespace odolab {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> number_from(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const std::from_chars_result read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec == std::errc::result_out_of_range && read.ptr == text.data() + text.size()) {
    // Too small to hold is zero to every purpose here; too large is no number.
    const std::size_t e = text.find_first_of("eE");
    if (e != std::string_view::npos && e + 1 < text.size() && text[e + 1] == '-') return 0.0;
    return std::nullopt;
  }
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string_view with_decimal_point(std::string_view cell, std::string& buffer) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos || cell.find('.') != std::string_view::npos ||
      cell.find(',', comma + 1) != std::string_view::npos)
    return cell;
  buffer = cell;
  buffer[comma] = '.';
  return buffer;
}

bool says_nothing(std::string_view cell) {
  constexpr std::string_view kWords[] = {"", "nan", "na", "n/a", "#n/a", "#na", "null", "none", "nil"};
  const auto is_same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
  return std::any_of(std::begin(kWords), std::end(kWords), [&](std::string_view word) {
    return std::equal(cell.begin(), cell.end(), word.begin(), word.end(), is_same);
  });
}

void append_number(std::string& text, double value) {
  char buffer[40];
  const std::to_chars_result written = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, written.ptr);
}

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string decimal_text(double value) {
  std::string text = number_text(value);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string printable(std::string_view text) {
  constexpr std::size_t kMostLetters = 40, kLongestLetter = 4;
  const std::string valid = valid_utf8(text.substr(0, kLongestLetter * (kMostLetters + 1)));
  const auto goes_on = [&](std::size_t at) { return at < valid.size() && (valid[at] & 0xC0) == 0x80; };
  std::string result;
  std::size_t letters = 0;
  for (std::size_t at = 0, end = 0; at < valid.size(); at = end, ++letters) {
    if (letters == kMostLetters) return result + "...";
    for (end = at + 1; goes_on(end);) ++end;
    const std::string_view letter = std::string_view(valid).substr(at, end - at);
    const auto first = static_cast<unsigned char>(letter.front());
    const bool steers = first < ' ' || first == 127 || (first == 0xC2 && static_cast<unsigned char>(letter[1]) < 0xA0);
    result += steers || letter == "\xEF\xBF\xBD" ? std::string_view("?") : letter;
  }
  return result;
}

std::string in_quotes(std::string_view text) { return "'" + printable(text) + "'"; }

std::string number_text(const char* format, double value) { return formatted(format, value); }

}  // namespace odolab
