// Plain rows of numbers without a header, as many foreign formats have them.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/recording/recording.h"

namespace odolab {

struct NumberRowsShape {
  std::size_t cells = 0;     // that are read from each row
  bool more_cells = false;   // whether a row may have more, which are ignored
  char separator = ',';      // ' ' stands for any run of blanks and tabs
  bool empty_cells = false;  // whether a cell may be empty (NaN)
  std::size_t first_line = 1;
  std::size_t never_empty = std::numeric_limits<std::size_t>::max();  // a column that needs a number all the same
};

struct NumberRows {
  std::vector<std::vector<double>> columns;
  std::vector<std::size_t> lines;  // where each row stood
  std::size_t size() const { return lines.size(); }
};

// Lines that begin with '#' and empty lines are skipped. Errors name file and line.
Result<NumberRows> read_number_rows(const std::string& path, const NumberRowsShape& shape);

// Of a column of stamps that goes back, or jumps by more than a day.
std::optional<Error> fault_of_stamps(const std::string& path, const NumberRows& rows, std::size_t column);

// The number of cells of the first line with anything in it, if all of them are numbers; else 0.
std::size_t numbers_in_first_row(std::string_view text, char separator);

// What was sampled on one clock: a column of values for each channel.
struct SampledChannels {
  std::vector<double> time_s;  // never decreasing
  std::vector<Channel> channels;
};

// Both on one clock, row by row in order of time; samples with the same stamp share a row.
Recording merged(const SampledChannels& a, const SampledChannels& b);

}  // namespace odolab
