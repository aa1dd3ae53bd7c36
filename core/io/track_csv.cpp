#include "core/io/track_csv.h"

#include <cmath>

#include "core/io/csv_table.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

const std::vector<std::string> kColumns = {"time_s", "x_m", "y_m", "heading_rad"};

}  // namespace

Result<Track> read_track_csv(const std::string& path) {
  const Result<CsvTable> table = read_csv_table(path, kColumns, [](std::string_view name) {
    for (const std::string& known : kColumns)
      if (name == known) return CsvCells::numbers;
    return CsvCells::anything;
  });
  if (!table) return table.error();
  const std::vector<double>& time_s = *table->column("time_s");
  const std::vector<double>&x_m = *table->column("x_m"), &y_m = *table->column("y_m");
  const std::vector<double>& heading_rad = *table->column("heading_rad");
  Track track;
  track.reserve(time_s.size());
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    // only a jump is unwrapped: what is continuous keeps its bits
    const double before_rad = i > 0 ? track.back().pose.heading_rad : heading_rad[i];
    const bool jumps = std::abs(heading_rad[i] - before_rad) > kPi;
    track.push_back({time_s[i], {x_m[i], y_m[i], jumps ? unwrapped(heading_rad[i], before_rad) : heading_rad[i]}});
  }
  return track;
}

Result<Done> write_track_csv(const std::string& path, const Track& track) {
  CsvTable table{kColumns, std::vector<std::vector<double>>(4)};
  for (const TimedPose& p : track) {
    table.columns[0].push_back(p.time_s);
    table.columns[1].push_back(p.pose.x_m);
    table.columns[2].push_back(p.pose.y_m);
    table.columns[3].push_back(p.pose.heading_rad);
  }
  return write_whole_file(path, csv_text(table));
}

}  // namespace odolab
