// OptiOdom, raw: `_odo.csv` on the robot's clock and the Motive export `_opti.csv` on the cameras', lined up by the
// start and stop times in `_metadata.csv` where that lies beside them. README.md says what was measured about them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/base/formatted.h"
#include "core/io/import/clock_alignment.h"
#include "core/io/import/format.h"
#include "core/io/import/number_rows.h"
#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

bool is_optiodom_odometry(std::string_view start) { return numbers_in_first_row(start, ',') == 3; }
bool is_motive(std::string_view start) {
  if (start.substr(0, 3) == "\xEF\xBB\xBF") start.remove_prefix(3);
  return start.substr(0, 14) == "Format Version";
}
bool recognises_raw(const std::string&, std::string_view start) {
  return is_optiodom_odometry(start) || is_motive(start);
}

// The same name with another ending, or nothing where the name does not end so.
std::string with_ending(const std::string& path, const std::string& ending, const std::string& other) {
  if (path.size() < ending.size() || path.compare(path.size() - ending.size(), ending.size(), ending) != 0) return {};
  return path.substr(0, path.size() - ending.size()) + other;
}

// A stamp of the robot's clock, written with a few decimals, without the noise of subtracting another.
double to_nanoseconds(double time_s) { return std::round(time_s * 1e9) * 1e-9; }

Result<SampledChannels> read_odometry(const std::string& path) {
  NumberRowsShape shape;
  shape.cells = 3;
  const Result<NumberRows> rows = read_number_rows(path, shape);
  if (!rows) return rows.error();
  if (const std::optional<Error> fault = fault_of_stamps(path, *rows, 0)) return *fault;
  SampledChannels odometry;
  odometry.channels = {{"left_ticks", rows->columns[1]}, {"right_ticks", rows->columns[2]}};
  for (std::size_t i = 0; i < rows->size(); ++i) {
    odometry.time_s.push_back(to_nanoseconds(rows->columns[0][i] - rows->columns[0][0]));
    if (i > 0)
      for (Channel& c : odometry.channels) c.values[i] += c.values[i - 1];
  }
  return odometry;
}

// Where Motive says how well each of the body's markers was seen, 0 to 1: columns that the header's last line but one
// names. None in exports without markers.
std::vector<std::size_t> quality_columns(const std::string& path) {
  constexpr std::size_t kHeader = 1 << 16, kLine = 6;
  const std::string start = read_file_start(path, kHeader);
  std::string_view rest = start;
  for (std::size_t line = 1; line < kLine; ++line)
    rest.remove_prefix(std::min(std::min(rest.find('\n'), rest.size()) + 1, rest.size()));
  rest = rest.substr(0, rest.find('\n'));
  std::vector<std::size_t> columns;
  for (std::size_t column = 0; !rest.empty(); ++column) {
    const std::size_t size = std::min(rest.find(','), rest.size());
    if (trimmed(rest.substr(0, size)) == "Marker Quality") columns.push_back(column);
    rest.remove_prefix(std::min(size + 1, rest.size()));
  }
  return columns;
}

// Frames that are left out: without the body, or with fewer of its markers than usual. A body that is laid onto those
// that are left steps aside by millimetres and by a degree for as long as one is hidden.
struct LeftOutFrames {
  std::size_t without_body = 0, without_a_marker = 0;
};

Result<SampledChannels> read_motive(const std::string& path, LeftOutFrames& left_out) {
  constexpr double kSeen = 0.01;
  const std::vector<std::size_t> qualities = quality_columns(path);
  NumberRowsShape shape;
  shape.cells = 8;  // frame, time, rotation Y X Z, position X Y Z
  if (!qualities.empty()) shape.cells = qualities.back() + 1;
  shape.more_cells = true;
  shape.empty_cells = true;
  shape.never_empty = 1;
  shape.first_line = 8;
  const Result<NumberRows> rows = read_number_rows(path, shape);
  if (!rows) return rows.error();
  if (const std::optional<Error> fault = fault_of_stamps(path, *rows, 1)) return *fault;
  SampledChannels truth;
  truth.channels = {{"truth_x_m", {}}, {"truth_y_m", {}}, {"truth_heading_rad", {}}};
  std::vector<char> sees_all(rows->size(), 1);
  for (std::size_t i = 0; i < rows->size(); ++i)
    for (const std::size_t column : qualities) sees_all[i] = sees_all[i] && rows->columns[column][i] > kSeen;
  // A marker that fell off is missed by all frames alike.
  const bool usual = 2 * static_cast<std::size_t>(std::count(sees_all.begin(), sees_all.end(), 1)) > rows->size();
  double heading_rad = 0.0;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const double time_s = rows->columns[1][i];
    const double rotation_y_deg = rows->columns[2][i], x_m = rows->columns[5][i], z_m = rows->columns[7][i];
    if (std::isnan(rotation_y_deg) || std::isnan(x_m) || std::isnan(z_m)) {
      ++left_out.without_body;
      continue;
    }
    if (usual && !sees_all[i]) {
      ++left_out.without_a_marker;
      continue;
    }
    // Y points up and the axes are right-handed, so the floor seen from above has x = X and y = -Z
    heading_rad = truth.time_s.empty() ? radians(rotation_y_deg) : unwrapped(radians(rotation_y_deg), heading_rad);
    truth.time_s.push_back(time_s);
    truth.channels[0].values.push_back(x_m);
    truth.channels[1].values.push_back(-z_m);
    truth.channels[2].values.push_back(heading_rad);
  }
  if (truth.time_s.empty()) return Error{path, "no frame with the body in sight", "one or more"};
  return truth;
}

// The hand-picked times of one run: [odo_ti, odo_tf] since the first row of the odometry, [gt_ti, gt_tf] on Motive's
// clock.
struct RunTimes {
  double odo_start_s = 0.0, odo_stop_s = 0.0, truth_start_s = 0.0, truth_stop_s = 0.0;
};

std::optional<double> value_of(std::string_view text, const std::string& key, std::size_t run) {
  while (!text.empty()) {
    const std::size_t size = std::min(text.find('\n'), text.size());
    std::string_view line = trimmed(text.substr(0, size));
    text.remove_prefix(std::min(size + 1, text.size()));
    if (line.substr(0, key.size() + 1) != key + ",") continue;
    for (std::size_t cell = 0; cell < run && !line.empty(); ++cell)
      line.remove_prefix(std::min(line.find(',') + 1, line.size()));
    return number_from(trimmed(line.substr(0, line.find(','))));
  }
  return std::nullopt;
}

std::optional<RunTimes> times_of_run(const std::string& odometry_path) {
  const std::size_t at = odometry_path.rfind("_run-");
  if (at == std::string::npos) return std::nullopt;
  const int run = std::atoi(odometry_path.c_str() + at + 5);
  const Result<std::string> text = read_whole_file(odometry_path.substr(0, at) + "_metadata.csv");
  if (!text || run < 1) return std::nullopt;
  const auto n = static_cast<std::size_t>(run);
  const std::optional<double> odo_start = value_of(*text, "odo_ti", n), odo_stop = value_of(*text, "odo_tf", n);
  const std::optional<double> truth_start = value_of(*text, "gt_ti", n), truth_stop = value_of(*text, "gt_tf", n);
  if (!odo_start || !odo_stop || !truth_start || !truth_stop) return std::nullopt;
  if (!(*odo_stop > *odo_start) || !(*truth_stop > *truth_start)) return std::nullopt;
  return RunTimes{*odo_start, *odo_stop, *truth_start, *truth_stop};
}

// Keeps what was sampled from `from_s` to `to_s`, a hair wider than the stamps' own noise.
void keep_between(SampledChannels& sampled, double from_s, double to_s) {
  const auto begin =
      std::lower_bound(sampled.time_s.begin(), sampled.time_s.end(), from_s - 1e-6) - sampled.time_s.begin();
  const auto end = std::upper_bound(sampled.time_s.begin(), sampled.time_s.end(), to_s + 1e-6) - sampled.time_s.begin();
  sampled.time_s = {sampled.time_s.begin() + begin, sampled.time_s.begin() + end};
  for (Channel& c : sampled.channels) c.values = {c.values.begin() + begin, c.values.begin() + end};
}

std::string rounded_text(double value, int decimals) { return formatted("%.*f", decimals, value); }

Result<ImportedRecording> read_raw(const std::vector<std::string>& sources) {
  if (sources.size() > 2) return Error{sources[2], "a third file", "an _odo.csv and an _opti.csv"};
  std::string odometry_path, motive_path;
  for (const std::string& source : sources) {
    std::string& kind = is_motive(read_file_start(source)) ? motive_path : odometry_path;
    if (!kind.empty()) return Error{source, "a second file of the same kind", "an _odo.csv and an _opti.csv"};
    kind = source;
  }
  if (motive_path.empty()) motive_path = with_ending(odometry_path, "_odo.csv", "_opti.csv");
  if (odometry_path.empty()) odometry_path = with_ending(motive_path, "_opti.csv", "_odo.csv");
  std::error_code failure;
  if (!std::filesystem::exists(motive_path, failure)) {
    const std::string synchronised = with_ending(odometry_path, "_odo.csv", ".csv");
    const bool there = !synchronised.empty() && std::filesystem::exists(synchronised, failure);
    return Error{odometry_path, "three columns as of OptiOdom's raw odometry, alone",
                 "its _opti.csv too, or --map for other columns" +
                     (there ? ", or the synchronised file '" + synchronised + "' instead" : std::string())};
  }
  if (!std::filesystem::exists(odometry_path, failure))
    return Error{motive_path, "the cameras' file alone", "its _odo.csv too"};

  Result<SampledChannels> odometry = read_odometry(odometry_path);
  if (!odometry) return odometry.error();
  LeftOutFrames left_out;
  Result<SampledChannels> truth = read_motive(motive_path, left_out);
  if (!truth) return truth.error();

  ImportedRecording imported;
  if (left_out.without_body > 0)
    imported.warnings.push_back(std::to_string(left_out.without_body) +
                                " frames of the cameras are left out: they had lost the body");
  if (left_out.without_a_marker > 0)
    imported.warnings.push_back(std::to_string(left_out.without_a_marker) +
                                " frames of the cameras are left out: a marker of the body was hidden, which moves it");
  if (const std::optional<RunTimes> times = times_of_run(odometry_path)) {
    const double rate = (times->odo_stop_s - times->odo_start_s) / (times->truth_stop_s - times->truth_start_s);
    for (double& t : truth->time_s) t = to_nanoseconds(times->odo_start_s + rate * (t - times->truth_start_s));
    keep_between(*truth, times->odo_start_s, times->odo_stop_s);
    keep_between(*odometry, times->odo_start_s, times->odo_stop_s);
    imported.warnings.push_back("the truth's stamps are moved by " + rounded_text(-times->truth_start_s, 2) +
                                " s and scaled by " + rounded_text(rate, 4) +
                                " onto the encoders' clock, by the hand-picked times in the metadata");
  } else {
    const double shift_s = truth_shift_by_turning(*odometry, *truth);
    for (double& t : truth->time_s) t = to_nanoseconds(t + shift_s);
    keep_between(*truth, odometry->time_s.front(), odometry->time_s.back());
    imported.warnings.push_back("no metadata lies beside the files: the truth's stamps are moved by " +
                                rounded_text(shift_s, 2) +
                                " s, so that its turning meets the wheels' at the start; its rate is as recorded");
  }
  imported.recording = merged(*odometry, *truth);
  imported.recording.name = std::filesystem::path(odometry_path).filename().string();
  imported.recording.provenance = "real: OptiOdom, raw encoders and OptiTrack";
  return imported;
}

}  // namespace

ForeignFormat optiodom_raw_format() {
  return {"OptiOdom, raw", "a raw OptiOdom pair (_odo.csv and _opti.csv)", recognises_raw, read_raw};
}

}  // namespace odolab
