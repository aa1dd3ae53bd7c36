#include "core/io/import/text_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/io/number_text.h"

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

std::optional<std::int64_t> stamp_ns(std::string_view text, std::int64_t unit_ns) {
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
