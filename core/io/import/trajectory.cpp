// Trajectories as text, of which a recording takes the truth: TUM (`t x y z qx qy qz qw`, seconds) and KITTI (twelve
// numbers, a 3x4 matrix row by row, times in another file).
#include <cmath>
#include <filesystem>

#include "core/io/import/format.h"
#include "core/io/import/text_rows.h"
#include "core/io/import/truth_stream.h"
#include "core/io/number_text.h"

namespace odolab {

namespace {

constexpr std::size_t kTumCells = 8, kKittiCells = 12;

// How many numbers the first row has that is no comment; 0 where one of its cells is none.
std::size_t numbers_in_row(std::string_view start) {
  std::vector<std::string_view> cells;
  while (!start.empty()) {
    const std::size_t size = start.find('\n');
    const std::string_view line = trimmed(start.substr(0, size));
    start.remove_prefix(size == std::string_view::npos ? start.size() : size + 1);
    if (line.empty() || line.front() == '#') continue;
    if (line.find_first_of(",;") != std::string_view::npos) return 0;
    split_cells(line, ' ', cells);
    for (std::string_view cell : cells)
      if (!number_from(cell)) return 0;
    return cells.size();
  }
  return 0;
}

bool recognises_tum(const std::string&, std::string_view start) { return numbers_in_row(start) == kTumCells; }
bool recognises_kitti(const std::string&, std::string_view start) { return numbers_in_row(start) == kKittiCells; }

TextShape blank_separated() {
  TextShape shape;
  shape.delimiter = ' ';
  return shape;
}

// The numbers of a row; false, and the reason kept, where it does not have them.
bool numbers_of(const TextRows& rows, const std::vector<std::string_view>& cells, std::size_t wanted, double* numbers,
                RowsLeftOut& left_out) {
  if (cells.size() != wanted) {
    left_out.add(rows.line(), rows.cut() ? "the last line is cut off"
                                         : std::to_string(cells.size()) + " cells, not " + std::to_string(wanted));
    return false;
  }
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::optional<double> value = number_from(cells[i]);
    if (!value) {
      left_out.add(rows.line(), in_quotes(cells[i]) + " is no number");
      return false;
    }
    numbers[i] = *value;
  }
  return true;
}

Result<Done> stream_tum(const std::string& path, const ImportWishes& wishes, SampleStreams& streams) {
  Result<TextRows> rows = TextRows::open(path, blank_separated(), streams.progress);
  if (!rows) return rows.error();
  TruthStream truth(streams, wishes.axes.value_or(SpaceAxes::z_up));
  RowsLeftOut left_out;
  std::vector<std::string_view> cells;
  double n[kTumCells];
  std::uint64_t kept = 0;
  while (rows->next(cells)) {
    if (!numbers_of(*rows, cells, kTumCells, n, left_out)) continue;
    const std::optional<std::int64_t> time_ns = stamp_ns(cells[0], 1'000'000'000);
    if (!time_ns) {
      left_out.add(rows->line(), in_quotes(cells[0]) + " is no time");
      continue;
    }
    kept += truth.add(*time_ns, {{n[1], n[2], n[3]}, rotation_of(n[4], n[5], n[6], n[7])});
  }
  if (kept == 0) return left_out.error(path, "rows of t x y z qx qy qz qw");
  const std::string name = std::filesystem::path(path).filename().string();
  left_out.warn(name, streams.warnings);
  truth.warn(name, streams.warnings);
  if (streams.provenance.empty()) streams.provenance = "trajectory";
  return Done{};
}

// Whether the body's axis that stays upright is z rather than y: which way the axes lie, where nobody says so.
bool z_stays_upright(const std::string& path) {
  Result<TextRows> rows = TextRows::open(path, blank_separated());
  if (!rows) return false;
  RowsLeftOut ignored;
  std::vector<std::string_view> cells;
  double n[kKittiCells], z = 0.0, y = 0.0;
  while (rows->next(cells))
    if (numbers_of(*rows, cells, kKittiCells, n, ignored)) z += n[10], y += n[5];
  return z > y;
}

Result<Done> stream_kitti(const std::string& path, const ImportWishes& wishes, SampleStreams& streams) {
  std::string times = wishes.times;
  std::error_code failure;
  const std::filesystem::path beside = std::filesystem::path(path).parent_path() / "times.txt";
  if (times.empty() && std::filesystem::exists(beside, failure)) times = beside.string();
  if (times.empty() && !(wishes.mapping.period_s > 0.0))
    return Error{path, "poses without times", "a times.txt beside them, --times FILE or --period SECONDS"};
  Result<TextRows> rows = TextRows::open(path, blank_separated(), streams.progress);
  if (!rows) return rows.error();
  std::optional<TextRows> stamps;
  if (!times.empty()) {
    Result<TextRows> opened = TextRows::open(times, blank_separated());
    if (!opened) return opened.error();
    stamps = std::move(*opened);
  }
  const std::string name = std::filesystem::path(path).filename().string();
  SpaceAxes axes = wishes.axes.value_or(SpaceAxes::camera);
  if (!wishes.axes) {
    if (z_stays_upright(path)) axes = SpaceAxes::z_up;
    streams.warnings.push_back(name + ": axes taken to be " + (axes == SpaceAxes::z_up ? "z up" : "a camera's") +
                               ", as that axis stays upright; --axes says otherwise");
  }
  TruthStream truth(streams, axes);
  RowsLeftOut left_out;
  std::vector<std::string_view> cells, stamp_cells;
  double n[kKittiCells];
  std::int64_t row_number = 0;
  std::uint64_t kept = 0;
  while (rows->next(cells)) {
    std::optional<std::int64_t> time_ns;
    if (stamps) {
      if (!stamps->next(stamp_cells)) {
        left_out.add(rows->line(), std::filesystem::path(times).filename().string() + " has no more times");
        continue;
      }
      time_ns = stamp_ns(stamp_cells.front(), 1'000'000'000);
    } else {
      time_ns = whole_ns(static_cast<double>(row_number) * wishes.mapping.period_s * 1e9);
    }
    ++row_number;
    if (!time_ns) {
      left_out.add(rows->line(), in_quotes(stamp_cells.front()) + " is no time");
      continue;
    }
    if (!numbers_of(*rows, cells, kKittiCells, n, left_out)) continue;
    kept += truth.add(*time_ns, {{n[3], n[7], n[11]}, {n[0], n[1], n[2], n[4], n[5], n[6], n[8], n[9], n[10]}});
  }
  if (kept == 0) return left_out.error(path, "rows of twelve numbers");
  left_out.warn(name, streams.warnings);
  truth.warn(name, streams.warnings);
  if (streams.provenance.empty()) streams.provenance = "trajectory";
  return Done{};
}

}  // namespace

ForeignFormat tum_format() {
  return {"TUM trajectories", "a TUM trajectory (t x y z qx qy qz qw)", recognises_tum, nullptr, stream_tum};
}

ForeignFormat kitti_format() {
  return {"KITTI trajectories", "KITTI poses (twelve numbers a row) with their times", recognises_kitti, nullptr,
          stream_kitti};
}

}  // namespace odolab
