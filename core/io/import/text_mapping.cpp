#include "core/io/import/text_mapping.h"

#include <algorithm>

#include "core/geometry/angles.h"
#include "core/io/import/text_rows.h"
#include "core/io/number_text.h"
#include "core/io/recording_csv.h"
#include "core/io/toml_table.h"

namespace odolab {

namespace {

const std::vector<std::string> kColumnKinds = {"total", "rate", "increment"};

bool is_quaternion(const std::string& channel) {
  return channel == "truth_qx" || channel == "truth_qy" || channel == "truth_qz" || channel == "truth_qw";
}

struct UnitWord {
  const char* name;
  double factor;
};

std::optional<double> factor_among(const std::string& unit, std::initializer_list<UnitWord> units) {
  for (const UnitWord& known : units)
    if (unit == known.name) return known.factor;
  return std::nullopt;
}

std::string units_of(const std::string& channel, ColumnKind kind) {
  if (channel == "time_s") return "s, ms, us or ns";
  if (channel.ends_with("_ticks")) return kind == ColumnKind::rate ? "counts/s" : "counts";
  if (channel.ends_with("_radps")) return "rad/s, deg/s or rpm";
  if (channel.ends_with("_mps")) return "m/s, cm/s, mm/s or km/h";
  const bool angle = channel.ends_with("_rad");
  if (kind == ColumnKind::rate) return angle ? "rad/s, deg/s, turns/s or rpm" : "m/s, cm/s, mm/s or km/h";
  return angle ? "rad, deg, mrad or turns" : "m, cm or mm";
}

std::optional<Error> problem_in(const MappedColumn& column, const std::string& where) {
  const std::string& channel = column.becomes;
  if (channel != "time_s" && !is_quaternion(channel) && !is_recording_column(channel))
    return Error{
        where, in_quotes(channel),
        "a column of a recording, such as time_s, left_wheel_rad, left_ticks, command_speed_mps, truth_x_m, or "
        "truth_qx to truth_qw"};
  if (column.column.empty())
    return Error{where + ": " + channel, "no column", "a name of the header or a number from 1"};
  if (!unit_factor(channel, column.kind, column.unit))
    return Error{where + ": " + channel, in_quotes(column.unit), units_of(channel, column.kind)};
  const bool adds_up = channel.ends_with("_wheel_rad") || channel.ends_with("_ticks") || channel == "steering_rad";
  if (column.kind != ColumnKind::total && !adds_up)
    return Error{where + ": " + channel, kColumnKinds[static_cast<std::size_t>(column.kind)],
                 "total: only wheels are added up from rates and increments"};
  return std::nullopt;
}

void put_column(TextMapping& mapping, MappedColumn column) {
  for (MappedColumn& known : mapping.columns)
    // files that are given together may call their time differently
    if (known.becomes == column.becomes && (column.becomes != "time_s" || known.column == column.column)) {
      known = std::move(column);
      return;
    }
  mapping.columns.push_back(std::move(column));
}

}  // namespace

std::optional<double> unit_factor(const std::string& channel, ColumnKind kind, const std::string& unit) {
  if (unit.empty()) return 1.0;
  const double turn = 2.0 * kPi;
  if (channel == "time_s") return factor_among(unit, {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}});
  if (is_quaternion(channel)) return std::nullopt;
  const bool rate = kind == ColumnKind::rate;
  if (channel.ends_with("_ticks")) return factor_among(unit, {{rate ? "counts/s" : "counts", 1.0}});
  if (channel.ends_with("_radps") || (rate && channel.ends_with("_rad")))
    return factor_among(unit, {{"rad/s", 1.0}, {"deg/s", kPi / 180.0}, {"turns/s", turn}, {"rpm", turn / 60.0}});
  if (channel.ends_with("_mps") || (rate && channel.ends_with("_m")))
    return factor_among(unit, {{"m/s", 1.0}, {"cm/s", 0.01}, {"mm/s", 0.001}, {"km/h", 1.0 / 3.6}});
  if (channel.ends_with("_rad"))
    return factor_among(unit, {{"rad", 1.0}, {"deg", kPi / 180.0}, {"mrad", 1e-3}, {"turns", turn}});
  return factor_among(unit, {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}});
}

std::optional<Error> add_column(TextMapping& mapping, const std::string& words) {
  const std::size_t equals = words.find('=');
  if (equals == std::string::npos || equals == 0)
    return Error{"--map", in_quotes(words), "CHANNEL=COLUMN, then what is known of it: left_wheel_rad=-enc_l,deg,rate"};
  MappedColumn column;
  column.becomes = words.substr(0, equals);
  std::vector<std::string_view> cells;
  const std::string rest = words.substr(equals + 1);
  split_cells(rest, ',', cells);
  std::string_view name = cells.empty() ? std::string_view() : cells.front();
  if (!name.empty() && name.front() == '-') {
    column.factor = -1.0;
    name.remove_prefix(1);
  }
  column.column = name;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const auto kind = std::find(kColumnKinds.begin(), kColumnKinds.end(), cells[i]);
    if (kind != kColumnKinds.end())
      column.kind = static_cast<ColumnKind>(kind - kColumnKinds.begin());
    else if (const std::optional<double> factor = number_from(cells[i]))
      column.factor *= *factor;
    else
      column.unit = cells[i];
  }
  if (auto problem = problem_in(column, "--map")) return problem;
  put_column(mapping, std::move(column));
  return std::nullopt;
}

std::optional<char> delimiter_of(const std::string& word) {
  if (word == "comma" || word == ",") return ',';
  if (word == "semicolon" || word == ";") return ';';
  if (word == "tab" || word == "\t") return '\t';
  if (word == "blank" || word == " ") return ' ';
  return std::nullopt;
}

Result<TextMapping> read_text_mapping(const std::string& path) {
  Result<TomlTable> top = TomlTable::read(path);
  if (!top) return top.error();
  TextMapping mapping;
  std::string delimiter;
  top->field("delimiter", delimiter);
  top->field("comment", mapping.shape.comment);
  top->field("skip_lines", mapping.shape.skip_lines);
  top->field("period_s", mapping.period_s);
  if (!delimiter.empty()) {
    if (const std::optional<char> c = delimiter_of(delimiter))
      mapping.shape.delimiter = *c;
    else
      top->fail({top->place_of("delimiter") + ": delimiter", in_quotes(delimiter), "comma, semicolon, tab or blank"});
  }
  int number = 0;
  for (TomlTable& table : top->tables("column")) {
    MappedColumn column;
    ++number;
    table.require("becomes");
    table.require("column");
    table.field("becomes", column.becomes);
    table.field("column", column.column);
    table.field("unit", column.unit);
    table.choice("kind", column.kind, kColumnKinds);
    table.field("factor", column.factor);
    if (table.failure()) break;
    const std::string where = top->place_of("column[" + std::to_string(number) + "]");
    if (auto problem = problem_in(column, where)) top->fail(*problem);
    put_column(mapping, std::move(column));
  }
  if (Result<Done> done = top->finish(); !done) return done.error();
  if (mapping.empty()) return Error{path, "no [[column]]", "one for each column that is to be read"};
  return mapping;
}

}  // namespace odolab
