// Any text of rows and columns, through a mapping that a person gives.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/io/import/format.h"
#include "core/io/import/planar_pose.h"
#include "core/io/import/text_rows.h"
#include "core/io/number_text.h"
#include "core/recording/clock_jump.h"
#include "core/recording/value_range.h"

namespace odolab {

namespace {

constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

struct Source {
  const MappedColumn* mapped = nullptr;
  std::size_t cell = kNowhere;
  double factor = 1.0;
  // of what is added up
  double sum = 0.0, previous_rate = kEmpty;
  std::int64_t previous_ns = 0;
};

std::optional<std::size_t> column_index(const std::string& column, const std::vector<std::string>& header,
                                        std::size_t cells) {
  for (std::size_t i = 0; i < header.size(); ++i)
    if (header[i] == column) return i;
  const std::optional<double> number = number_from(column);
  if (number && *number >= 1.0 && *number <= static_cast<double>(cells) && *number == std::floor(*number))
    return static_cast<std::size_t>(*number) - 1;
  return std::nullopt;
}

std::string listed_in_quotes(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 12; ++i) text += (i ? ", " : "") + in_quotes(names[i]);
  return names.size() > 12 ? text + ", ..." : text;
}

bool all_numbers_or_times(TextRows& rows, const std::vector<std::string_view>& cells) {
  for (std::string_view cell : cells)
    if (!says_nothing(cell) && !rows.number(cell) && !time_of_day_ns(cell) && !stamp_ns(cell, 1)) return false;
  return true;
}

// ROS writes a stamp as two columns of one name: its whole seconds, and the nanoseconds after them.
struct StampColumns {
  std::size_t seconds, nanoseconds;
};

// Those that a mapped column of the time is one of, or that it is the common name of.
std::optional<StampColumns> stamp_columns(const MappedColumn& time, std::optional<std::size_t> at,
                                          const std::vector<std::string>& header) {
  if (time.factor != 1.0) return std::nullopt;
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t i = 0; i < header.size(); ++i)
    for (const std::string seconds : {"sec", "secs"}) {
      if (!header[i].ends_with(seconds)) continue;
      const std::string before = header[i].substr(0, header[i].size() - seconds.size());
      if (!before.empty() && is_letter(before.back())) continue;
      for (const std::string nanoseconds : {"nanosec", "nanosecs", "nsec", "nsecs"}) {
        const auto found = std::find(header.begin(), header.end(), before + nanoseconds);
        if (found == header.end()) continue;
        const StampColumns stamp{i, static_cast<std::size_t>(found - header.begin())};
        const bool is_common_name = !at && !before.empty() && before.substr(0, before.size() - 1) == time.column;
        if ((at == stamp.seconds || is_common_name) && (time.unit.empty() || time.unit == "s")) return stamp;
        if (at == stamp.nanoseconds && (time.unit.empty() || time.unit == "ns")) return stamp;
      }
    }
  return std::nullopt;
}

double added_up(Source& source, double value, std::int64_t time_ns) {
  if (source.mapped->kind == ColumnKind::increment) return source.sum += value;
  if (!std::isnan(source.previous_rate))
    source.sum += 0.5 * (source.previous_rate + value) * static_cast<double>(time_ns - source.previous_ns) * 1e-9;
  source.previous_rate = value;
  source.previous_ns = time_ns;
  return source.sum;
}

// The columns of the mapping found in a file.
struct Layout {
  std::vector<Source> sources;  // one for each channel of the stream, in its order
  Source time, quaternion[4];
  std::size_t nanoseconds = kNowhere;  // of the stamp whose whole seconds are the time
  std::vector<std::string> channels;
};

std::optional<Error> lay_out(const TextMapping& mapping, const std::vector<std::string>& header, std::size_t cells,
                             const std::string& path, std::uint64_t line, bool one_of_several, Layout& layout) {
  for (const MappedColumn& column : mapping.columns) {
    std::optional<std::size_t> at = column_index(column.column, header, cells);
    if (std::count(header.begin(), header.end(), column.column) > 1)
      return Error{path + ":" + std::to_string(line), "several columns " + in_quotes(column.column),
                   "one, or the column's number in the mapping"};
    std::optional<StampColumns> stamp;
    if (column.becomes == "time_s") stamp = stamp_columns(column, at, header);
    if (stamp) at = stamp->seconds;
    if (!at && one_of_several && !header.empty()) continue;
    if (!at)
      return Error{
          path + ":" + std::to_string(line),
          header.empty() ? std::to_string(cells) + " columns without names" : "the columns " + listed_in_quotes(header),
          "a column " + in_quotes(column.column) + " for " + column.becomes};
    const Source source{&column, *at,
                        unit_factor(column.becomes, column.kind, column.unit).value_or(1.0) * column.factor};
    if (column.becomes == "time_s") {
      layout.time = source;
      layout.nanoseconds = stamp ? stamp->nanoseconds : kNowhere;
    } else if (column.becomes.substr(0, 7) == "truth_q") {
      layout.quaternion[std::string("xyzw").find(column.becomes.back())] = source;
    } else {
      layout.channels.push_back(column.becomes);
      layout.sources.push_back(source);
    }
  }
  if (layout.channels.empty() && layout.quaternion[2].cell == kNowhere && layout.quaternion[3].cell == kNowhere)
    return Error{path + ":" + std::to_string(line), "the columns " + listed_in_quotes(header),
                 "one that the mapping names for wheels, commands or truth, as in left_wheel_rad=COLUMN"};
  if (layout.time.cell == kNowhere && !(mapping.period_s > 0.0)) {
    const auto time = std::find_if(mapping.columns.begin(), mapping.columns.end(),
                                   [](const MappedColumn& c) { return c.becomes == "time_s"; });
    if (time != mapping.columns.end())
      return Error{path + ":" + std::to_string(line), "the columns " + listed_in_quotes(header),
                   "a column " + in_quotes(time->column) + " for time_s"};
    return Error{path, "no column for time_s", "time_s=COLUMN, or a period between rows"};
  }
  return std::nullopt;
}

std::int64_t unit_ns(const std::string& unit) {
  return unit == "ns" ? 1 : unit == "us" ? 1000 : unit == "ms" ? 1'000'000 : 1'000'000'000;
}

// No log of a drive has rows so far apart: where no unit was given, its stamps are hardly seconds.
std::optional<std::string> no_seconds(const MappedColumn& time, double lasted_s, std::uint64_t rows) {
  constexpr std::uint64_t kFewest = 10;
  constexpr double kFarApart_s = 5.0;
  const double apart_s = rows > 1 ? lasted_s / static_cast<double>(rows - 1) : 0.0;
  if (!time.unit.empty() || time.factor != 1.0 || rows < kFewest || apart_s < kFarApart_s) return std::nullopt;
  return "rows are " + number_text("%.3g", apart_s) + " s apart if '" + time.column +
         "' is in seconds: time_s=" + time.column + ",ms (or us, ns) says otherwise";
}

// Whole seconds that a log of more rows than one a second bears.
struct WholeSeconds {
  bool all = true;
  std::uint64_t repeated = 0, first_line = 0;  // rows with the stamp of the row before
  std::int64_t last_ns = 0;

  void add(std::int64_t time_ns, bool is_first, std::uint64_t line) {
    all = all && time_ns % 1'000'000'000 == 0;
    if (!is_first && time_ns == last_ns && repeated++ == 0) first_line = line;
    last_ns = time_ns;
  }
  std::optional<std::string> doubt(const MappedColumn& time, std::uint64_t rows) const {
    constexpr std::uint64_t kFewest = 10;
    if (!all || rows < kFewest || 2 * repeated < rows) return std::nullopt;
    return std::to_string(repeated) + " of " + std::to_string(rows) +
           " rows bear the same stamp as the row before, the first in line " + std::to_string(first_line) + ": " +
           in_quotes(time.column) +
           " has whole seconds; map time_s to a column with parts of them, or leave it out and give the period between "
           "rows";
  }
};

// The second of a row and the nanoseconds after it; nothing where they are none.
std::optional<std::int64_t> added_ns(std::optional<std::int64_t> second_ns, std::optional<std::int64_t> after_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  if (!second_ns || !after_ns || *second_ns % kSecond_ns != 0 || *after_ns < 0 || *after_ns >= kSecond_ns)
    return std::nullopt;
  return *second_ns + *after_ns;
}

bool recognises_none(const std::string&, std::string_view) { return false; }  // only where a mapping is given

Result<Done> stream_mapped_text(const std::string& path, const ImportWishes& wishes, SampleStreams& streams) {
  const TextMapping& mapping = wishes.mapping;
  Result<TextRows> rows = TextRows::open(path, mapping.shape, streams.progress);
  if (!rows) return rows.error();
  std::vector<std::string_view> cells;
  if (!rows->next(cells)) return Error{path, "no rows", "a header or numbers"};

  // names stand in a first row that is not all numbers, or in the comment above the first row
  std::vector<std::string> header;
  const bool named = !all_numbers_or_times(*rows, cells);
  if (named) {
    header.assign(cells.begin(), cells.end());
  } else if (!rows->last_comment().empty()) {
    std::vector<std::string_view> names;
    split_cells(rows->last_comment(), rows->delimiter(), names);
    if (names.size() == cells.size()) header.assign(names.begin(), names.end());
  }
  Layout layout;
  if (auto error = lay_out(mapping, header, cells.size(), path, rows->line(), streams.several_sources, layout))
    return *error;
  const bool has_quaternion = layout.quaternion[3].cell != kNowhere || layout.quaternion[2].cell != kNowhere;
  if (has_quaternion) layout.channels.push_back("truth_heading_rad");
  SampleSpool& spool = streams.add_stream(layout.channels);
  for (std::size_t i = 0; i < layout.sources.size(); ++i)
    if (layout.sources[i].mapped->kind == ColumnKind::total && layout.channels[i].ends_with("wheel_rad"))
      spool.unwrap(i);

  RowsLeftOut left_out;
  JumpWatch watch;
  Error jump;
  std::vector<double> values(layout.channels.size());
  std::int64_t first_ns = 0, last_ns = std::numeric_limits<std::int64_t>::min(), row_number = 0;
  std::uint64_t kept = 0, out_of_order = 0;
  WholeSeconds whole_seconds;
  bool more = !named || rows->next(cells);
  for (; more; more = rows->next(cells)) {
    const auto cell_at = [&](std::size_t at) { return at < cells.size() ? cells[at] : std::string_view(); };
    const auto cell_of = [&](const Source& source) { return cell_at(source.cell); };
    std::optional<std::int64_t> time_ns;
    if (layout.nanoseconds != kNowhere) {
      time_ns = added_ns(rows->stamp_ns(cell_of(layout.time), unit_ns("s")),
                         rows->stamp_ns(cell_at(layout.nanoseconds), unit_ns("ns")));
    } else if (layout.time.cell != kNowhere) {
      time_ns = rows->stamp_ns(cell_of(layout.time), unit_ns(layout.time.mapped->unit));
      if (time_ns && layout.time.mapped->factor != 1.0)
        time_ns = whole_ns(static_cast<double>(*time_ns) * layout.time.mapped->factor);
    } else {
      time_ns = whole_ns(static_cast<double>(row_number++) * mapping.period_s * 1e9);
    }
    if (!time_ns && layout.nanoseconds != kNowhere) {
      left_out.add(rows->line(), in_quotes(cell_of(layout.time)) + " and " + in_quotes(cell_at(layout.nanoseconds)) +
                                     " are no whole second and its nanoseconds");
      continue;
    }
    if (!time_ns) {
      left_out.add(rows->line(), in_quotes(cell_of(layout.time)) + " is no time in " +
                                     (layout.time.cell == kNowhere || layout.time.mapped->unit.empty()
                                          ? std::string("s (ms, us, ns say otherwise)")
                                          : layout.time.mapped->unit));
      continue;
    }
    // A wheel turned by what its cell says, whatever else is wrong with the row.
    const auto add_increments = [&] {
      for (Source& source : layout.sources)
        if (source.mapped->kind == ColumnKind::increment)
          source.sum += rows->number(cell_of(source)).value_or(0.0) * source.factor;
    };
    if (*time_ns < last_ns) {
      add_increments();
      left_out.add(rows->line(), "time goes back");
      ++out_of_order;
      continue;
    }
    std::string problem;
    const auto number = [&](const Source& source) {
      const std::string_view cell = cell_of(source);
      if (source.cell >= cells.size())
        problem = rows->cut() ? "the last line is cut off" : std::to_string(cells.size()) + " cells, too few";
      if (says_nothing(cell)) return kEmpty;
      const std::optional<double> value = rows->number(cell);
      if (!value) problem = in_quotes(cell) + " is no number";
      return value ? *value * source.factor : kEmpty;
    };
    bool any = false;
    for (std::size_t i = 0; i < layout.sources.size(); ++i) {
      const Source& source = layout.sources[i];
      const std::string& channel = layout.channels[i];
      values[i] = number(source);
      if (source.mapped->kind == ColumnKind::total && std::abs(values[i]) > largest_value(channel))
        problem = in_quotes(cell_of(source)) + " for " + channel + " is not " + range_text(channel);
    }
    if (has_quaternion) {
      double q[4];
      for (int i = 0; i < 4; ++i) q[i] = layout.quaternion[i].cell == kNowhere ? 0.0 : number(layout.quaternion[i]);
      const SpacePose pose{{}, rotation_of(q[0], q[1], q[2], q[3])};
      values.back() = planar_pose(pose, wishes.axes.value_or(SpaceAxes::z_up)).floor_T_body.heading_rad;
    }
    if (!problem.empty()) {
      add_increments();
      left_out.add(rows->line(), problem);
      continue;
    }
    if (watch.add(1e-9 * static_cast<double>(*time_ns)))
      jump = {
          path + ":" + std::to_string(rows->line()) + ": time_s",
          "a row " + number_text("%.10g", 1e-9 * static_cast<double>(*time_ns - last_ns)) + " s after the one before",
          std::string(kRowsOfOneClock) + ", in the unit that the mapping gives (s, ms, us, ns)"};
    last_ns = *time_ns;
    for (std::size_t i = 0; i < layout.sources.size(); ++i)
      if (layout.sources[i].mapped->kind != ColumnKind::total && !std::isnan(values[i]))
        values[i] = added_up(layout.sources[i], values[i], *time_ns);
    for (double& value : values) {
      if (!std::isfinite(value)) value = kEmpty;
      any = any || !std::isnan(value);
    }
    if (!any) continue;  // a row of other columns
    whole_seconds.add(*time_ns, kept == 0, rows->line());
    if (kept++ == 0) first_ns = *time_ns;
    spool.add(*time_ns, values.data());
  }
  if (out_of_order > kept)
    return Error{path,
                 "rows that are not in order of time, " + std::to_string(out_of_order) + " of " +
                     std::to_string(out_of_order + kept),
                 "rows in order of time: sort them first"};
  constexpr std::uint64_t kFew = 10;
  if (kept == 0 || (left_out.count() > kept && left_out.count() > kFew))
    return left_out.error(path, "rows of numbers in the mapped columns");
  if (const std::string cell = rows->doubtful_comma(); !cell.empty())
    return Error{path, in_quotes(cell) + ", whose comma may divide thousands",
                 "decimal points, or cells that semicolons divide"};
  if (!watch.is_one_clock()) return jump;
  const std::string name = std::filesystem::path(path).filename().string();
  left_out.warn(name, streams.warnings);
  if (layout.nanoseconds != kNowhere)
    streams.warnings.push_back(name + ": time_s is the sum of " + in_quotes(header[layout.time.cell]) + " and " +
                               in_quotes(header[layout.nanoseconds]));
  if (layout.time.cell != kNowhere) {
    if (const auto doubt = no_seconds(*layout.time.mapped, 1e-9 * static_cast<double>(last_ns - first_ns), kept))
      streams.warnings.push_back(name + ": " + *doubt);
    if (const auto doubt = whole_seconds.doubt(*layout.time.mapped, kept))
      streams.warnings.push_back(name + ": " + *doubt);
  }
  if (rows->decimal_commas()) streams.warnings.push_back(name + ": commas in numbers are taken for decimal points");
  if (streams.provenance.empty()) streams.provenance = "text, by a mapping";
  return Done{};
}

}  // namespace

ForeignFormat mapped_text_format() {
  return {"mapped text", "any text of columns with --map or --mapping", recognises_none, nullptr, stream_mapped_text};
}

}  // namespace odolab
