#include "core/io/import/text_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

constexpr std::size_t kLongestLine = 1 << 20;
constexpr std::size_t kUsualLine = 1 << 12;
constexpr std::int64_t kLatest_ns = 4'102'444'800'000'000'000;  // the year 2100

}  // namespace

Result<TextRows> TextRows::open(const std::string& path, const TextShape& shape, const Progress& progress) {
  Result<FileWindow> file = FileWindow::open(path, progress);
  if (!file) return file.error();
  if (file->peek(3) == "\xEF\xBB\xBF") file->advance(3);
  const std::string_view start = file->peek(kUsualLine);
  if (is_utf16(start)) return utf16_error(path);
  const std::size_t carriage_return = start.find('\r');
  if (carriage_return != std::string_view::npos && carriage_return + 1 < start.size() &&
      start.find('\n') == std::string_view::npos)
    return Error{path, "lines that end in a carriage return alone", "line feeds: 'tr \"\\r\" \"\\n\"' makes them"};
  TextRows rows(std::move(*file), shape);
  std::string_view line;
  for (int i = 0; i < shape.skip_lines && rows.next_line(line); ++i) {
  }
  return rows;
}

bool TextRows::next_line(std::string_view& line) {
  if (file_.left() == 0) return false;
  std::string_view bytes;
  std::size_t end = std::string_view::npos;
  for (std::size_t wanted : {kUsualLine, kLongestLine}) {
    bytes = file_.peek(wanted);
    end = bytes.find('\n');
    if (end != std::string_view::npos || bytes.size() < wanted) break;
  }
  cut_ = end == std::string_view::npos;
  line = bytes.substr(0, end);
  // the view stays valid: stepping over what the buffer holds does not move it
  file_.advance(cut_ ? bytes.size() : end + 1);
  ++line_;
  return !bytes.empty();
}

std::string_view TextRows::with_point(std::string_view cell) {
  return shape_.delimiter == ',' ? cell : with_decimal_point(cell, pointed_);
}

std::optional<double> TextRows::number(std::string_view cell) {
  const std::string_view pointed = with_point(cell);
  const std::optional<double> value = number_from(pointed);
  if (value && pointed.data() != cell.data()) decimal_commas_ = true;
  return value;
}

std::optional<std::int64_t> TextRows::stamp_ns(std::string_view cell, std::int64_t unit_ns) {
  return odolab::stamp_ns(with_point(cell), unit_ns);
}

bool TextRows::next(std::vector<std::string_view>& cells) {
  std::string_view line;
  while (next_line(line)) {
    line = trimmed(line);
    if (line.empty()) continue;
    if (!shape_.comment.empty() && line.substr(0, shape_.comment.size()) == shape_.comment) {
      last_comment_ = trimmed(line.substr(shape_.comment.size()));
      continue;
    }
    if (shape_.delimiter == 0) shape_.delimiter = likely_delimiter(line);
    split_cells(line, shape_.delimiter, cells);
    return true;
  }
  return false;
}

void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  std::size_t from = 0;
  bool inside_quotes = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') inside_quotes = !inside_quotes;
    const bool ends =
        i == line.size() || (!inside_quotes && (delimiter == ' ' ? blank(line[i]) : line[i] == delimiter));
    if (!ends) continue;
    std::string_view cell = trimmed(line.substr(from, i - from));
    from = i + 1;
    if (delimiter == ' ' && cell.empty()) continue;
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
  }
}

char likely_delimiter(std::string_view line) {
  for (char c : {'\t', ';', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

void RowsLeftOut::add(std::uint64_t line, const std::string& why) {
  if (count_++ > 0) return;
  first_line_ = line;
  first_why_ = why;
}

void RowsLeftOut::warn(const std::string& file, std::vector<std::string>& warnings) const {
  if (count_ > 0)
    warnings.push_back(file + ": " + std::to_string(count_) + (count_ == 1 ? " row" : " rows") +
                       " left out, the first in line " + std::to_string(first_line_) + ": " + first_why_);
}

Error RowsLeftOut::error(const std::string& path, const std::string& expected) const {
  if (count_ == 0) return {path, "no rows", expected};
  return {path + ":" + std::to_string(first_line_), first_why_, expected};
}

namespace {

// Days from 1970 to a date of the Gregorian calendar (H. Hinnant, chrono-compatible low-level date algorithms).
std::int64_t days_from_1970(std::int64_t year, std::int64_t month, std::int64_t day) {
  year -= month <= 2;
  const std::int64_t era = year / 400, of_era = year - 400 * era;
  const std::int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return 146097 * era + 365 * of_era + of_era / 4 - of_era / 100 + of_year - 719468;
}

// "2024-01-31T12:00:00.25", a blank in place of the T, with Z or an offset behind or nothing.
std::optional<std::int64_t> date_ns(std::string_view text) {
  const auto digits = [&](std::size_t at, std::size_t n) -> std::int64_t {
    std::int64_t value = 0;
    for (std::size_t i = at; i < at + n; ++i) {
      if (i >= text.size() || text[i] < '0' || text[i] > '9') return -1;
      value = 10 * value + (text[i] - '0');
    }
    return value;
  };
  const auto is = [&](std::size_t at, char a, char b) { return at < text.size() && (text[at] == a || text[at] == b); };
  const std::int64_t year = digits(0, 4), month = digits(5, 2), day = digits(8, 2), hour = digits(11, 2),
                     minute = digits(14, 2), second = digits(17, 2);
  if (!is(4, '-', '/') || !is(7, '-', '/') || !is(10, 'T', ' ') || !is(13, ':', ':') || !is(16, ':', ':') ||
      year < 1970 || year > 2099 || month < 1 || month > 12 || day < 1 || day > 31 || hour < 0 || hour > 23 ||
      minute < 0 || minute > 59 || second < 0 || second > 60)
    return std::nullopt;
  std::int64_t ns = ((days_from_1970(year, month, day) * 24 + hour) * 60 + minute) * 60 + second;
  ns *= 1'000'000'000;
  std::size_t at = 19;
  if (is(at, '.', ',')) {
    std::int64_t place = 100'000'000;
    for (++at; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at, place /= 10)
      ns += place * (text[at] - '0');
  }
  if (at == text.size() || (text[at] == 'Z' && at + 1 == text.size())) return ns;
  const std::int64_t hours = digits(at + 1, 2), minutes = digits(at + (is(at + 3, ':', ':') ? 4 : 3), 2);
  const std::size_t whole = at + (is(at + 3, ':', ':') ? 6 : 5);
  if (!is(at, '+', '-') || hours < 0 || minutes < 0 || text.size() != whole) return std::nullopt;
  const std::int64_t offset_ns = (hours * 60 + minutes) * 60'000'000'000;
  return text[at] == '+' ? ns - offset_ns : ns + offset_ns;
}

}  // namespace

std::optional<std::int64_t> stamp_ns(std::string_view text, std::int64_t unit_ns) {
  if (text.size() >= 19 && (text[4] == '-' || text[4] == '/')) return date_ns(text);
  const bool negative = !text.empty() && text.front() == '-';
  std::string_view digits = text;
  if (!digits.empty() && (digits.front() == '-' || digits.front() == '+')) digits.remove_prefix(1);
  std::int64_t whole = 0, part_ns = 0, place_ns = unit_ns;
  bool any = false, after_point = false;
  for (char c : digits) {
    if (c == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (c < '0' || c > '9') {
      any = false;
      break;
    }
    any = true;
    const std::int64_t digit = c - '0';
    if (!after_point) {
      if (whole > kLatest_ns / unit_ns / 10) return std::nullopt;
      whole = 10 * whole + digit;
    } else {
      const std::int64_t before = place_ns;
      place_ns /= 10;
      part_ns += digit * place_ns;
      if (before == 1 && digit >= 5) ++part_ns, place_ns = 0;  // the first digit below a nanosecond rounds
      if (before <= 1) place_ns = 0;
    }
  }
  if (any && whole <= kLatest_ns / unit_ns) {
    const std::int64_t ns = whole * unit_ns + part_ns;
    return negative ? -ns : ns;
  }
  // with an exponent
  const std::optional<double> value = number_from(text);
  return value ? whole_ns(*value * static_cast<double>(unit_ns)) : std::nullopt;
}

std::optional<std::int64_t> whole_ns(double ns) {
  if (!(std::abs(ns) <= static_cast<double>(kLatest_ns))) return std::nullopt;
  return std::llround(ns);
}

}  // namespace odolab
