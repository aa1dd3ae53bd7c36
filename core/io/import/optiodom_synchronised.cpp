// OptiOdom, synchronised: one CSV without a header, `t, x, y, heading, ticks right, ticks left`, ticks of each cycle.
#include <cmath>
#include <filesystem>

#include "core/io/import/format.h"
#include "core/io/import/number_rows.h"
#include "core/io/number_text.h"

namespace odolab {

namespace {

bool recognises_synchronised(const std::string&, std::string_view start) {
  return numbers_in_first_row(start, ',') == 6;
}

Result<ImportedRecording> read_synchronised(const std::vector<std::string>& sources) {
  if (sources.size() > 1) return Error{sources[1], "a second file", "one synchronised file alone"};
  const std::string& path = sources.front();
  NumberRowsShape shape;
  shape.cells = 6;
  const Result<NumberRows> rows = read_number_rows(path, shape);
  if (!rows) return rows.error();
  ImportedRecording imported;
  Recording& recording = imported.recording;
  recording.name = std::filesystem::path(path).filename().string();
  recording.provenance = "real: OptiOdom, synchronised by its authors";
  recording.time_s = rows->columns[0];
  if (const std::optional<Error> fault = fault_of_stamps(path, *rows, 0)) return *fault;
  for (const std::size_t column : {4u, 5u})
    for (std::size_t i = 0; i < rows->size(); ++i)
      if (const double ticks = rows->columns[column][i]; ticks != std::round(ticks))
        return Error{
            path + ":" + std::to_string(rows->lines[i]) + ": column " + std::to_string(column + 1), number_text(ticks),
            "whole ticks: six columns without a header are a synchronised OptiOdom file; a CSV of one's own has "
            "one, as time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m"};
  // the counts of a cycle are those of the time up to its stamp: README.md
  std::vector<double> right = rows->columns[4], left = rows->columns[5];
  for (std::size_t i = 1; i < rows->size(); ++i) {
    right[i] += right[i - 1];
    left[i] += left[i - 1];
  }
  recording.channels = {{"left_ticks", std::move(left)},
                        {"right_ticks", std::move(right)},
                        {"truth_x_m", rows->columns[1]},
                        {"truth_y_m", rows->columns[2]},
                        {"truth_heading_rad", rows->columns[3]}};
  return imported;
}

}  // namespace

ForeignFormat optiodom_synchronised_format() {
  return {"OptiOdom, synchronised", "a synchronised OptiOdom file (six columns)", recognises_synchronised,
          read_synchronised};
}

}  // namespace odolab
