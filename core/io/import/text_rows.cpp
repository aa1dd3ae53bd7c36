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

// One to three digits without a leading zero, a comma, and three more.
bool TextRows::looks_like_thousands(std::string_view cell) const {
  if (shape_.delimiter != ',') return false;
  if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) cell.remove_prefix(1);
  const std::size_t comma = cell.find(',');
  return comma >= 1 && comma <= 3 && cell.front() != '0' && cell.size() == comma + 4 &&
         cell.find_first_of(".eE") == std::string_view::npos;
}

void TextRows::note_point(std::string_view cell) {
  if (cell.find(',') == std::string_view::npos) {
    points_ = points_ || cell.find('.') != std::string_view::npos;
    return;
  }
  decimal_commas_ = true;
  const bool thousands = looks_like_thousands(cell);
  surely_decimal_ = surely_decimal_ || !thousands;
  if (thousands && thousands_.empty()) thousands_ = cell;
}

std::optional<double> TextRows::number(std::string_view cell) {
  if (points_ && looks_like_thousands(cell)) return std::nullopt;
  const std::optional<double> value = number_from(with_decimal_point(cell, pointed_));
  if (value) note_point(cell);
  return value;
}

std::optional<std::int64_t> TextRows::stamp_ns(std::string_view cell, std::int64_t unit_ns) {
  if (const std::optional<std::int64_t> of_day_ns = time_of_day_ns(cell)) {
    constexpr std::int64_t kHour_ns = 3'600'000'000'000, kDay_ns = 24 * kHour_ns;
    // a row that comes late steps back by little, midnight by almost a day
    const std::int64_t step_ns = *of_day_ns - last_of_day_ns_.value_or(*of_day_ns);
    if (step_ns < -kHour_ns && midnight_ns_ < kLatest_ns) midnight_ns_ += kDay_ns;
    if (step_ns > kDay_ns - kHour_ns && midnight_ns_ > -kLatest_ns) midnight_ns_ -= kDay_ns;
    last_of_day_ns_ = of_day_ns;
    return midnight_ns_ + *of_day_ns;
  }
  const bool is_date = cell.find(':') != std::string_view::npos;
  if (!is_date && points_ && looks_like_thousands(cell)) return std::nullopt;
  const std::optional<std::int64_t> ns = odolab::stamp_ns(with_decimal_point(cell, pointed_), unit_ns);
  if (ns && !is_date) note_point(cell);
  return ns;
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

// The number that n digits make from there on; -1 where they are none.
std::int64_t digits(std::string_view text, std::size_t at, std::size_t n) {
  std::int64_t value = 0;
  for (std::size_t i = at; i < at + n; ++i) {
    if (i >= text.size() || text[i] < '0' || text[i] > '9') return -1;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

bool is_either(std::string_view text, std::size_t at, char a, char b) {
  return at < text.size() && (text[at] == a || text[at] == b);
}

// "12:00:00.25" from there on, with so many digits for the hour; `at` is moved behind it.
std::optional<std::int64_t> hours_to_seconds_ns(std::string_view text, std::size_t& at, std::size_t of_hour) {
  const std::size_t colon = at + of_hour;
  const std::int64_t hour = digits(text, at, of_hour), minute = digits(text, colon + 1, 2),
                     second = digits(text, colon + 4, 2);
  if (!is_either(text, colon, ':', ':') || !is_either(text, colon + 3, ':', ':') || hour < 0 || hour > 23 ||
      minute < 0 || minute > 59 || second < 0 || second > 60)
    return std::nullopt;
  std::int64_t ns = ((hour * 60 + minute) * 60 + second) * 1'000'000'000;
  at = colon + 6;
  if (is_either(text, at, '.', ',')) {
    std::int64_t place = 100'000'000;
    for (++at; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at, place /= 10)
      ns += place * (text[at] - '0');
  }
  return ns;
}

// "2024-01-31T12:00:00.25", a blank in place of the T, with Z or an offset behind or nothing.
std::optional<std::int64_t> date_ns(std::string_view text) {
  const std::int64_t year = digits(text, 0, 4), month = digits(text, 5, 2), day = digits(text, 8, 2);
  if (!is_either(text, 4, '-', '/') || !is_either(text, 7, '-', '/') || !is_either(text, 10, 'T', ' ') || year < 1970 ||
      year > 2099 || month < 1 || month > 12 || day < 1 || day > 31)
    return std::nullopt;
  std::size_t at = 11;
  const std::optional<std::int64_t> of_day_ns = hours_to_seconds_ns(text, at, 2);
  if (!of_day_ns) return std::nullopt;
  const std::int64_t ns = days_from_1970(year, month, day) * 86'400'000'000'000 + *of_day_ns;
  if (at == text.size() || (text[at] == 'Z' && at + 1 == text.size())) return ns;
  const std::int64_t hours = digits(text, at + 1, 2),
                     minutes = digits(text, at + (is_either(text, at + 3, ':', ':') ? 4 : 3), 2);
  const std::size_t whole = at + (is_either(text, at + 3, ':', ':') ? 6 : 5);
  if (!is_either(text, at, '+', '-') || hours < 0 || minutes < 0 || text.size() != whole) return std::nullopt;
  const std::int64_t offset_ns = (hours * 60 + minutes) * 60'000'000'000;
  return text[at] == '+' ? ns - offset_ns : ns + offset_ns;
}

}  // namespace

std::optional<std::int64_t> time_of_day_ns(std::string_view text) {
  std::size_t at = 0;
  const std::optional<std::int64_t> ns = hours_to_seconds_ns(text, at, is_either(text, 1, ':', ':') ? 1 : 2);
  return at == text.size() ? ns : std::nullopt;
}

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
