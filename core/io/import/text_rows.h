// Rows of cells out of a text file, one at a time, in memory that does not grow with the file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/bag/file_window.h"
#include "core/io/import/text_mapping.h"

namespace odolab {

class TextRows {
 public:
  static Result<TextRows> open(const std::string& path, const TextShape& shape, const Progress& progress = {});

  // A number of a cell: a comma in one that has no point is its decimal point.
  std::optional<double> number(std::string_view cell);
  // Times of day go on past midnight, from that of the first one's day.
  std::optional<std::int64_t> stamp_ns(std::string_view cell, std::int64_t unit_ns);
  bool decimal_commas() const { return decimal_commas_; }  // whether there were any
  // A number in quotes, of a file that commas divide, whose comma divides thousands for all that the others say; empty
  // where there is none.
  std::string doubtful_comma() const { return points_ || !surely_decimal_ ? thousands_ : ""; }

  // The next row that holds anything; false at the end. The cells are valid until the next call; quotes around a cell
  // are taken off. A byte-order mark, CRLF and empty lines are tolerated; of a line beyond a megabyte the first one is
  // given.
  bool next(std::vector<std::string_view>& cells);

  std::uint64_t line() const { return line_; }  // of the last row, counted from 1
  bool cut() const { return cut_; }             // whether the last row ended with the file, without a line's end
  char delimiter() const { return shape_.delimiter; }
  const std::string& last_comment() const { return last_comment_; }  // before the last row, without its mark

 private:
  TextRows(FileWindow file, TextShape shape) : file_(std::move(file)), shape_(std::move(shape)) {}
  bool next_line(std::string_view& line);
  bool looks_like_thousands(std::string_view cell) const;
  void note_point(std::string_view cell);

  FileWindow file_;
  TextShape shape_;
  std::uint64_t line_ = 0;
  bool cut_ = false;
  // of the numbers that were read: points, commas, commas that divide no thousands, and the first that might
  bool points_ = false, decimal_commas_ = false, surely_decimal_ = false;
  std::string last_comment_, pointed_, thousands_;
  std::optional<std::int64_t> last_of_day_ns_;
  std::int64_t midnight_ns_ = 0;
};

// Cells of one line at a delimiter, blanks and quotes around each taken off.
void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells);

// What a first row is most likely divided by: tab, semicolon, comma, else blanks.
char likely_delimiter(std::string_view line);

// Counts rows that had to be left out, and says so with the first one's place.
class RowsLeftOut {
 public:
  void add(std::uint64_t line, const std::string& why);
  std::uint64_t count() const { return count_; }
  void warn(const std::string& file, std::vector<std::string>& warnings) const;
  Error error(const std::string& path, const std::string& expected) const;  // where nothing else was there

 private:
  std::uint64_t count_ = 0, first_line_ = 0;
  std::string first_why_;
};

// A stamp in decimal digits as whole nanoseconds, exact for as many digits as a file may have; `unit_ns` is 1, 1000,
// ... of its unit. A date with a time ("2024-01-31 12:00:00.25", with T and an offset too) counts from 1970, UTC where
// it does not say otherwise. Nothing where it is neither, or beyond the year 2100.
std::optional<std::int64_t> stamp_ns(std::string_view text, std::int64_t unit_ns);
// "12:00:00" or "9:00:00.25" since midnight.
std::optional<std::int64_t> time_of_day_ns(std::string_view text);
std::optional<std::int64_t> whole_ns(double ns);  // rounded; within the same bounds

}  // namespace odolab
