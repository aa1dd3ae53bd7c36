// UTIAS multi-robot data set: `RobotN_Odometry.dat` (commanded speed and yaw rate) and `RobotN_Groundtruth.dat`.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/io/import/format.h"
#include "core/io/import/number_rows.h"

namespace odolab {

namespace {

constexpr std::string_view kOdometry = "Odometry", kGroundtruth = "Groundtruth";

bool is_mrclam_odometry(std::string_view start) { return start.find("# Odometry Data") != std::string_view::npos; }
bool is_groundtruth(std::string_view start) { return start.find("# Robot Groundtruth Data") != std::string_view::npos; }

bool recognises_mrclam(const std::string& path, std::string_view start) {
  if (start.empty() || start.front() != '#') return false;
  const std::string name = std::filesystem::path(path).filename().string();
  const bool named =
      name.find("_Odometry.dat") != std::string::npos || name.find("_Groundtruth.dat") != std::string::npos;
  return named || is_mrclam_odometry(start) || is_groundtruth(start);
}

bool holds_odometry(const std::string& path) {
  return std::filesystem::path(path).filename().string().find(kOdometry) != std::string::npos;
}

std::string partner_of(const std::string& path) {
  const std::filesystem::path file(path);
  std::string name = file.filename().string();
  const std::string_view mine = holds_odometry(path) ? kOdometry : kGroundtruth;
  const std::size_t at = name.find(mine);
  if (at == std::string::npos) return {};
  name.replace(at, mine.size(), holds_odometry(path) ? kGroundtruth : kOdometry);
  return (file.parent_path() / name).string();
}

// The rows as channels, without those whose stamp lies before one that came earlier in the file.
SampledChannels in_order(const NumberRows& rows, const std::vector<std::string>& names, std::size_t& dropped) {
  SampledChannels sampled;
  for (const std::string& name : names) sampled.channels.push_back({name, {}});
  dropped = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!sampled.time_s.empty() && rows.columns[0][i] < sampled.time_s.back()) {
      ++dropped;
      continue;
    }
    sampled.time_s.push_back(rows.columns[0][i]);
    for (std::size_t c = 0; c < names.size(); ++c) sampled.channels[c].values.push_back(rows.columns[c + 1][i]);
  }
  return sampled;
}

Result<ImportedRecording> read_mrclam(const std::vector<std::string>& sources) {
  if (sources.size() > 2)
    return Error{sources[2], "a third file", "an Odometry.dat and a Groundtruth.dat of one robot"};
  const std::string other = sources.size() == 2 ? sources[1] : partner_of(sources[0]);
  std::error_code failure;
  if (!std::filesystem::exists(other, failure))
    return Error{
        sources[0], holds_odometry(sources[0]) ? "the odometry alone" : "the ground truth alone",
        std::string("the robot's ") + (holds_odometry(sources[0]) ? "Groundtruth.dat" : "Odometry.dat") + " beside it"};
  if (holds_odometry(sources[0]) == holds_odometry(other))
    return Error{other, "a second file of the same kind", "an Odometry.dat and a Groundtruth.dat of one robot"};
  const std::string odometry_path = holds_odometry(sources[0]) ? sources[0] : other;
  const std::string truth_path = holds_odometry(sources[0]) ? other : sources[0];

  NumberRowsShape shape;
  shape.separator = ' ';
  shape.cells = 3;
  const Result<NumberRows> odometry_rows = read_number_rows(odometry_path, shape);
  if (!odometry_rows) return odometry_rows.error();
  shape.cells = 4;
  const Result<NumberRows> truth_rows = read_number_rows(truth_path, shape);
  if (!truth_rows) return truth_rows.error();

  ImportedRecording imported;
  std::size_t commands_dropped = 0, truths_dropped = 0;
  SampledChannels commands =
      in_order(*odometry_rows, {"command_speed_mps", "command_yaw_rate_radps"}, commands_dropped);
  SampledChannels truth = in_order(*truth_rows, {"truth_x_m", "truth_y_m", "truth_heading_rad"}, truths_dropped);
  const auto report = [&](std::size_t dropped, const std::string& path) {
    if (dropped > 0)
      imported.warnings.push_back(std::to_string(dropped) + (dropped == 1 ? " row of " : " rows of ") +
                                  std::filesystem::path(path).filename().string() + " left out: time goes back there");
  };
  report(commands_dropped, odometry_path);
  report(truths_dropped, truth_path);

  // seconds of 1970 leave no digits to spare; the source has milliseconds
  const double zero_s = std::min(commands.time_s.front(), truth.time_s.front());
  for (SampledChannels* sampled : {&commands, &truth})
    for (double& t : sampled->time_s) t = std::round((t - zero_s) * 1e6) / 1e6;
  imported.recording = merged(commands, truth);
  imported.recording.name = std::filesystem::path(odometry_path).filename().string();
  imported.recording.provenance = "real: UTIAS multi-robot data set, commands and Vicon";
  return imported;
}

}  // namespace

ForeignFormat mrclam_format() {
  return {"the UTIAS data set", "a UTIAS RobotN_Odometry.dat with its RobotN_Groundtruth.dat", recognises_mrclam,
          read_mrclam};
}

}  // namespace odolab
