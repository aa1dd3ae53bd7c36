#include "core/io/recording_csv.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "core/io/csv_table.h"
#include "core/io/whole_file.h"
#include "core/recording/value_range.h"

namespace odolab {

namespace {

constexpr std::array<std::string_view, 16> kPlainColumns = {
    "time_s",        "left_ticks",      "right_ticks",       "command_speed_mps", "command_yaw_rate_radps",
    "truth_x_m",     "truth_y_m",       "truth_heading_rad", "link_angle_a_rad",  "link_angle_b_rad",
    "link_length_m", "hitch_angle_rad", "left_wheel_rad",    "right_wheel_rad",   "drive_wheel_rad",
    "steering_rad"};

// Channels that say nothing without each other.
constexpr std::array<std::array<std::string_view, 2>, 8> kPairs = {
    {{"left_wheel_rad", "right_wheel_rad"},
     {"a_left_wheel_rad", "a_right_wheel_rad"},
     {"b_left_wheel_rad", "b_right_wheel_rad"},
     {"trailer_left_wheel_rad", "trailer_right_wheel_rad"},
     {"drive_wheel_rad", "steering_rad"},
     {"left_ticks", "right_ticks"},
     {"command_speed_mps", "command_yaw_rate_radps"},
     {"truth_x_m", "truth_y_m"}}};

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

// One wheel may be there in another unit than the other.
Error of_lonely_column(const std::string& path, const std::string& name, const std::string& partner,
                       const std::vector<std::string>& names) {
  constexpr std::array<std::array<std::string_view, 2>, 2> kSameWheel = {
      {{"left_wheel_rad", "left_ticks"}, {"right_wheel_rad", "right_ticks"}}};
  const auto other_unit = [&](std::string_view of) -> std::string {
    for (const auto& units : kSameWheel)
      for (int i : {0, 1})
        if (units[i] == of) return std::string(units[1 - i]);
    return "";
  };
  const std::string instead = other_unit(partner);
  if (std::find(names.begin(), names.end(), instead) == names.end())
    return {path + ":1", "the column '" + name + "' alone", "a column '" + partner + "' with it"};
  return {path + ":1", "the column '" + name + "' beside '" + instead + "'",
          "both wheels in one unit: '" + partner + "' with the first, or '" + other_unit(name) + "' with the second"};
}

}  // namespace

bool is_recording_column(std::string_view name) {
  // a_, b_, trailer_ and castorN_ stand before the names of a pair of wheels or a pivot
  return std::find(kPlainColumns.begin(), kPlainColumns.end(), name) != kPlainColumns.end() ||
         ends_with(name, "_left_wheel_rad") || ends_with(name, "_right_wheel_rad") ||
         (name.substr(0, 6) == "castor" && ends_with(name, "_pivot_rad"));
}

std::optional<std::pair<std::string, std::string>> without_partner(const std::vector<std::string>& names) {
  const auto has = [&](std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  for (const auto& pair : kPairs)
    for (int i : {0, 1})
      if (has(pair[i]) && !has(pair[1 - i])) return std::pair{std::string(pair[i]), std::string(pair[1 - i])};
  return std::nullopt;
}

Result<Recording> read_recording_csv(const std::string& path, const Progress& progress, AllowedValues values) {
  const auto cells_of = [](std::string_view name) {
    return is_recording_column(name) ? CsvCells::numbers_or_empty : CsvCells::anything;
  };
  const auto largest_of = [values](std::string_view name) {
    return values == AllowedValues::of_a_robot && is_recording_column(name) ? largest_value(name)
                                                                            : std::numeric_limits<double>::infinity();
  };
  Result<CsvTable> table = read_csv_table(path, {"time_s"}, cells_of, progress, largest_of);
  if (!table) return table.error();
  if (const auto lonely = without_partner(table->names))
    return of_lonely_column(path, lonely->first, lonely->second, table->names);
  Recording recording;
  recording.name = std::filesystem::path(path).filename().string();
  recording.provenance = "recording file";
  for (std::size_t i = 0; i < table->names.size(); ++i) {
    if (table->names[i] == "time_s") {
      recording.time_s = std::move(table->columns[i]);
    } else {
      recording.channels.push_back({std::move(table->names[i]), std::move(table->columns[i])});
    }
  }
  return recording;
}

Result<Done> write_recording_csv(const std::string& path, const Recording& recording) {
  const std::vector<std::string> problems = problems_in(recording);
  if (!problems.empty()) return Error{path + ": " + problems.front(), "", ""};
  CsvTable table;
  table.names.push_back("time_s");
  table.columns.push_back(recording.time_s);
  for (const Channel& channel : recording.channels) {
    table.names.push_back(channel.name);
    table.columns.push_back(channel.values);
  }
  return write_whole_file(path, csv_text(table));
}

}  // namespace odolab
