#include "core/io/import/number_rows.h"

#include <cstring>

#include "core/io/number_text.h"
#include "core/io/whole_file.h"
#include "core/recording/clock_jump.h"

namespace odolab {

namespace {

std::string_view without_byte_order_mark(std::string_view text) {
  return text.substr(0, 3) == "\xEF\xBB\xBF" ? text.substr(3) : text;
}

std::string_view next_line(std::string_view& rest, bool& ended) {
  const std::size_t size = rest.find('\n');
  ended = size != std::string_view::npos;
  const std::string_view line = trimmed(rest.substr(0, size));
  rest.remove_prefix(ended ? size + 1 : rest.size());
  return line;
}

// The next cell of a line that has one; `more` says whether another follows it.
std::string_view next_cell(std::string_view& line, char separator, bool& more) {
  const std::size_t size = separator == ' ' ? line.find_first_of(" \t") : line.find(separator);
  more = size != std::string_view::npos;
  const std::string_view cell = trimmed(line.substr(0, size));
  line.remove_prefix(more ? size + 1 : line.size());
  if (separator == ' ') line = trimmed(line);
  return cell;
}

}  // namespace

Result<NumberRows> read_number_rows(const std::string& path, const NumberRowsShape& shape) {
  const Result<std::string> text = read_whole_file(path);
  if (!text) return text.error();
  std::string_view rest = without_byte_order_mark(*text);
  NumberRows rows;
  rows.columns.resize(shape.cells);
  const std::string expected_cells = std::to_string(shape.cells) + (shape.more_cells ? " or more" : "");
  for (std::size_t number = 1; !rest.empty(); ++number) {
    bool ended = true, more = true;
    std::string_view line = next_line(rest, ended);
    if (number < shape.first_line || line.empty() || line.front() == '#') continue;
    std::size_t cells = 0;
    while (more) {
      const std::string_view cell = next_cell(line, shape.separator, more);
      if (cells < shape.cells) {
        const std::optional<double> value = number_from(cell);
        // a number may have been cut in two at the end of the file: the missing cells say so better
        const bool cut_off = !ended && !more && cells + 1 < shape.cells;
        if (!value && !cut_off && !(cell.empty() && shape.empty_cells && cells != shape.never_empty))
          return Error{path + ":" + std::to_string(number) + ": column " + std::to_string(cells + 1),
                       cell.empty() ? "an empty cell" : in_quotes(cell), "a number"};
        rows.columns[cells].push_back(value.value_or(kEmpty));
      }
      ++cells;
    }
    if (cells < shape.cells || (cells > shape.cells && !shape.more_cells))
      return Error{path + ":" + std::to_string(number),
                   std::string(!ended && cells < shape.cells ? "a last line cut off after " : "") +
                       std::to_string(cells) + (cells == 1 ? " cell" : " cells"),
                   expected_cells};
    rows.lines.push_back(number);
  }
  if (rows.lines.empty()) return Error{path, "no rows", "rows of " + expected_cells + " numbers"};
  return rows;
}

std::size_t numbers_in_first_row(std::string_view text, char separator) {
  std::string_view rest = without_byte_order_mark(text);
  while (!rest.empty()) {
    bool ended = true, more = true;
    std::string_view line = next_line(rest, ended);
    if (line.empty()) continue;
    std::size_t cells = 0;
    for (; more; ++cells)
      if (!number_from(next_cell(line, separator, more))) return 0;
    return cells;
  }
  return 0;
}

std::optional<Error> fault_of_stamps(const std::string& path, const NumberRows& rows, std::size_t column) {
  const std::vector<double>& time_s = rows.columns[column];
  const auto at = [&](std::size_t row, const char* expected) {
    return Error{path + ":" + std::to_string(rows.lines[row]) + ": column " + std::to_string(column + 1),
                 number_text(time_s[row]) + " after " + number_text(time_s[row - 1]), expected};
  };
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (time_s[i] < time_s[i - 1]) return at(i, "times that never decrease");
  if (const std::optional<std::size_t> row = first_after_jump(time_s)) return at(*row, kRowsOfOneClock);
  return std::nullopt;
}

Recording merged(const SampledChannels& a, const SampledChannels& b) {
  Recording recording;
  for (const Channel& c : a.channels) recording.channels.push_back({c.name, {}});
  for (const Channel& c : b.channels) recording.channels.push_back({c.name, {}});
  std::size_t i = 0, j = 0;
  while (i < a.time_s.size() || j < b.time_s.size()) {
    const bool from_a = i < a.time_s.size() && (j == b.time_s.size() || a.time_s[i] <= b.time_s[j]);
    const bool from_b = j < b.time_s.size() && (i == a.time_s.size() || b.time_s[j] <= a.time_s[i]);
    recording.time_s.push_back(from_a ? a.time_s[i] : b.time_s[j]);
    std::size_t column = 0;
    for (const Channel& c : a.channels) recording.channels[column++].values.push_back(from_a ? c.values[i] : kEmpty);
    for (const Channel& c : b.channels) recording.channels[column++].values.push_back(from_b ? c.values[j] : kEmpty);
    if (from_a) ++i;
    if (from_b) ++j;
  }
  return recording;
}

}  // namespace odolab
