// How the columns of somebody's text file become the channels of a recording.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace odolab {

struct TextShape {
  char delimiter = 0;         // ' ' stands for any run of blanks and tabs; 0: found out from the first row
  std::string comment = "#";  // what begins a line that is none; empty: nothing does
  int skip_lines = 0;         // before anything else
};

// What a column's numbers are.
enum class ColumnKind {
  total,      // the value itself; of a wheel its rotation since the start
  rate,       // per second: integrated over time, straight between neighbours
  increment,  // since the row before: added up
};

struct MappedColumn {
  std::string becomes;  // a recording's column; time_s; truth_qx, truth_qy, truth_qz, truth_qw make truth_heading_rad
  std::string column;   // a name of the header, or a number from 1
  std::string unit;     // of the file; empty: the channel's own
  ColumnKind kind = ColumnKind::total;
  double factor = 1.0;  // after the unit: -1 turns a wheel that is mounted the other way round
};

struct TextMapping {
  TextShape shape;
  std::vector<MappedColumn> columns;
  double period_s = 0.0;  // between rows, where no column has the time
  bool empty() const { return columns.empty(); }
};

// What one of a unit is in the channel's own unit, for rates in that unit per second; nothing where it does not fit the
// channel. Angles: rad, deg, mrad, turns; lengths: m, cm, mm; counts; time: s, ms, us, ns; rates: those with /s, rpm,
// km/h.
std::optional<double> unit_factor(const std::string& channel, ColumnKind kind, const std::string& unit);

// "left_wheel_rad=-enc_l,deg,rate": channel, column, then unit, kind and factor in any order; a minus before the column
// is a factor of -1. Replaces an earlier column of the same channel, but for another time_s.
std::optional<Error> add_column(TextMapping& mapping, const std::string& words);

// A TOML file: delimiter ("comma", "semicolon", "tab", "blank"), comment, skip_lines, period_s, and [[column]] with
// becomes, column, unit, kind ("total", "rate", "increment") and factor.
Result<TextMapping> read_text_mapping(const std::string& path);

// ',' and so on from such a word or the character itself.
std::optional<char> delimiter_of(const std::string& word);

}  // namespace odolab
