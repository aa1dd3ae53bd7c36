// A CSV file with a header, one column of numbers for each name; the common ground of recordings and tracks.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace odolab {

// Columns of equal length; NaN where a cell is empty.
struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  const std::vector<double>* column(std::string_view name) const;  // null where there is none
};

// How strictly a column is read. Each needs `time_s`, without gaps and never decreasing.
enum class CsvCells {
  numbers,           // every cell is a number
  numbers_or_empty,  // a cell may be empty, or say so (`says_nothing`)
  anything,          // what is no number is taken as empty
};

// Reads a whole table. CRLF, a byte-order mark, blanks around cells, quotes, empty lines, comments above the header and
// semicolons or tabs in the place of commas (decimal commas, then) are tolerated; so is a time that goes back by one
// unit of the last digit that times are written with, which is read as the one before. Errors name
// file, line and column: no header, a missing or doubled column, a cell that is no number, a line with too few or too
// many cells, a last line that is cut off, time that goes back or jumps by more than a day, no
// row at all, a number beyond `largest_of` its column.
Result<CsvTable> read_csv_table(const std::string& path, const std::vector<std::string>& required_columns,
                                const std::function<CsvCells(std::string_view name)>& cells_of,
                                const Progress& progress = {},
                                const std::function<double(std::string_view name)>& largest_of = {});

// The text of such a file; NaN becomes an empty cell, and numbers are exact.
std::string csv_text(const CsvTable& table);
// A column's name as it stands in a header: in quotes where it holds a comma.
std::string csv_name(const std::string& name);

}  // namespace odolab
