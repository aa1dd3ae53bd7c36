#include "core/io/csv_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/io/import/text_rows.h"
#include "core/io/number_text.h"
#include "core/io/whole_file.h"
#include "core/recording/clock_jump.h"
#include "core/recording/value_range.h"

namespace odolab {

namespace {

// What divides the names of a header: a comma, or what spreadsheets write where that is the decimal point.
char divider_of(std::string_view header) {
  const char likely = likely_delimiter(header);
  return likely == ' ' || header.find(',') != std::string_view::npos ? ',' : likely;
}

std::string listed_columns(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 8; ++i) text += (i ? ", " : "") + in_quotes(names[i]);
  return names.size() > 8 ? text + ", ..." : text;
}

std::string counted_in_words(std::size_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

// Of a number as it is written, how many digits stand behind its decimal point.
int decimals_written(std::string_view cell) {
  const std::size_t e = cell.find_first_of("eE"), point = cell.substr(0, e).find_first_of(".,");
  const std::size_t end = std::min(e, cell.size());
  const int written = point < end ? static_cast<int>(end - point) - 1 : 0;
  if (e == std::string_view::npos) return written;
  return written - static_cast<int>(number_from(cell.substr(e + 1)).value_or(0.0));
}

// Sensors that round their stamps in ways of their own come one unit of the last digit too early after each other. One
// of a tenth of a second or more is no rounding.
bool is_rounding(double before_s, double time_s, int decimals) {
  constexpr int kFewestDecimals = 2;
  constexpr double kOneUnit = 1.5;  // less than two, whatever binary numbers make of it
  const double finest_s = std::nextafter(before_s, INFINITY) - before_s;
  return decimals >= kFewestDecimals && before_s - time_s <= kOneUnit * std::pow(10.0, -decimals) + finest_s;
}

}  // namespace

const std::vector<double>* CsvTable::column(std::string_view name) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return &columns[i];
  return nullptr;
}

Result<CsvTable> read_csv_table(const std::string& path, const std::vector<std::string>& required_columns,
                                const std::function<CsvCells(std::string_view name)>& cells_of,
                                const Progress& progress,
                                const std::function<double(std::string_view name)>& largest_of) {
  const Result<std::string> file = read_whole_file(path, progress);
  if (!file) return file.error();
  std::string_view rest = *file;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);
  if (is_utf16(rest)) return utf16_error(path);

  const std::size_t carriage_return = rest.find('\r');
  if (carriage_return != std::string_view::npos && carriage_return + 1 < rest.size() &&
      rest.find('\n') == std::string_view::npos)
    return Error{path, "lines that end in a carriage return alone", "line feeds: 'tr \"\\r\" \"\\n\"' makes them"};

  CsvTable table;
  std::vector<std::string_view> cells;
  std::vector<CsvCells> kinds;
  std::vector<double> largest;
  std::size_t time_column = 0;
  char delimiter = ',';
  int decimals = 0;  // most that a stamp is written with
  std::string pointed;
  const auto number_in = [&](std::string_view cell) {
    return number_from(delimiter == ',' ? cell : with_decimal_point(cell, pointed));
  };
  constexpr std::size_t kLinesAtOnce = 4096;
  std::size_t line_number = 0, line_after_jump = 0;
  while (!rest.empty()) {
    const void* newline = std::memchr(rest.data(), '\n', rest.size());
    const bool ended = newline != nullptr;
    const std::size_t size =
        ended ? static_cast<std::size_t>(static_cast<const char*>(newline) - rest.data()) : rest.size();
    const std::string_view line = rest.substr(0, size);
    rest.remove_prefix(ended ? size + 1 : size);
    ++line_number;
    if (line_number % kLinesAtOnce == 0 &&
        !goes_on(progress, 1.0 - static_cast<double>(rest.size()) / static_cast<double>(file->size())))
      return stopped_reading(path);
    if (trimmed(line).empty()) continue;
    if (table.names.empty() && line.front() == '#') continue;  // a comment above the header
    if (table.names.empty()) delimiter = divider_of(line);
    split_cells(line, delimiter, cells);
    const std::string place = path + ":" + std::to_string(line_number);

    if (table.names.empty()) {
      const auto is_number = [&](std::string_view cell) { return number_in(cell).has_value(); };
      if (std::any_of(cells.begin(), cells.end(), is_number) &&
          std::all_of(cells.begin(), cells.end(), [&](auto cell) { return is_number(cell) || says_nothing(cell); }))
        return Error{place, "numbers", "a header line that names the columns, 'time_s' among them"};
      for (std::string_view name : cells) table.names.emplace_back(name);
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (!cells[i].empty() && std::find(cells.begin(), cells.begin() + i, cells[i]) != cells.begin() + i)
          return Error{place, "the column " + in_quotes(cells[i]) + " twice", "each column once"};
      for (const std::string& required : required_columns)
        if (std::find(table.names.begin(), table.names.end(), required) == table.names.end())
          return Error{place, "the columns " + listed_columns(table.names),
                       "a column " + in_quotes(required) +
                           (required == "time_s" ? "; odolab import --map reads other names" : "")};
      time_column = std::find(table.names.begin(), table.names.end(), "time_s") - table.names.begin();
      for (const std::string& name : table.names) kinds.push_back(cells_of(name));
      for (const std::string& name : table.names) largest.push_back(largest_of ? largest_of(name) : INFINITY);
      table.columns.resize(table.names.size());
      const std::size_t rows_at_most = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 1;
      for (std::vector<double>& column : table.columns) column.reserve(rows_at_most);
      continue;
    }

    if (cells.size() != table.names.size()) {
      const bool cut_off = !ended && cells.size() < table.names.size();
      return Error{place, (cut_off ? "a last line cut off after " : "") + counted_in_words(cells.size(), "cell"),
                   std::to_string(table.names.size()) + ", one for each column of the header"};
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::optional<double> value = number_in(cells[i]);
      if (!value) {
        const bool empty = says_nothing(cells[i]);
        if (i == time_column || kinds[i] == CsvCells::numbers || (kinds[i] == CsvCells::numbers_or_empty && !empty))
          return Error{place + ": " + printable(table.names[i]), cells[i].empty() ? "an empty cell" : in_quotes(cells[i]),
                       "a number"};
        value = kEmpty;
      }
      if (std::abs(*value) > largest[i])
        return Error{place + ": " + printable(table.names[i]), in_quotes(cells[i]), range_text(table.names[i])};
      table.columns[i].push_back(*value);
    }
    std::vector<double>& time_s = table.columns[time_column];
    decimals = std::max(decimals, decimals_written(cells[time_column]));
    if (time_s.size() > 1 && time_s.back() < time_s[time_s.size() - 2] &&
        is_rounding(time_s[time_s.size() - 2], time_s.back(), decimals))
      time_s.back() = time_s[time_s.size() - 2];
    if (time_s.size() > 1 && time_s.back() < time_s[time_s.size() - 2])
      return Error{place + ": time_s", number_text(time_s.back()) + " after " + number_text(time_s[time_s.size() - 2]),
                   "times that never decrease"};
    if (line_after_jump == 0 && time_s.size() > 1 && time_s.back() - time_s[time_s.size() - 2] > kLongestPause_s)
      line_after_jump = line_number;
  }
  if (table.names.empty()) return Error{path, "an empty file", "a header line with a column 'time_s'"};
  if (table.columns[time_column].empty())
    return Error{path + ":" + std::to_string(line_number), "a header without rows", "one row or more"};
  const std::vector<double>& time_s = table.columns[time_column];
  if (line_after_jump > 0)
    if (const std::optional<std::size_t> row = first_after_jump(time_s))
      return Error{path + ":" + std::to_string(line_after_jump) + ": time_s",
                   number_text(time_s[*row]) + " after " + number_text(time_s[*row - 1]), kRowsOfOneClock};
  return table;
}

std::string csv_name(const std::string& name) { return name.find(',') == std::string::npos ? name : '"' + name + '"'; }

std::string csv_text(const CsvTable& table) {
  std::string text;
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().size();
  text.reserve(rows * table.columns.size() * 14);
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    if (i) text += ',';
    text += csv_name(table.names[i]);
  }
  text += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (i) text += ',';
      if (const double value = table.columns[i][row]; !std::isnan(value)) append_number(text, value);
    }
    text += '\n';
  }
  return text;
}

}  // namespace odolab
