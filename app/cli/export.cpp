#include <algorithm>

#include "app/cli/command.h"
#include "app/cli/overwriting.h"
#include "app/cli/terminal.h"
#include "core/io/export/plotjuggler_csv.h"
#include "core/io/export/tum_text.h"
#include "core/io/import/imported_recording.h"
#include "core/io/import/sample_streams.h"
#include "core/io/ros2_yaml.h"
#include "core/io/track_csv.h"
#include "core/io/vehicle_toml.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

struct ExportOptions {
  std::string source, to, out, nominal;
};

// The truth of a recording, or a track that predict or run wrote.
Result<Track> track_of(const std::string& path, const Progress& progress) {
  const std::string start = read_file_start(path);
  const std::string header = start.substr(0, start.find('\n'));
  const bool is_track = header.find("time_s") != std::string::npos && header.find("heading_rad") != std::string::npos &&
                        header.find("truth_x_m") == std::string::npos;
  if (is_track) return read_track_csv(path);
  const Result<ImportedRecording> loaded = load_recording(path, progress);
  if (!loaded) return loaded.error();
  Track track = truth_track(loaded->recording);
  if (track.empty()) return Error{path, "no truth with a heading", "poses: a trajectory has orientations"};
  return track;
}

Result<DifferentialDrive> drive_of(const std::string& path) {
  const Result<Vehicle> vehicle = read_vehicle(path);
  if (!vehicle) return vehicle.error();
  if (const auto other = other_than_differential_drive(*vehicle, "diff_drive_controller drives"))
    return Error{path + ": " + other->where, other->found, other->expected};
  return std::get<DifferentialDrive>(vehicle->kind);
}

Result<Done> write_yaml(const ExportOptions& options) {
  const Result<DifferentialDrive> calibrated = drive_of(options.source);
  if (!calibrated) return calibrated.error();
  const Result<DifferentialDrive> nominal = options.nominal.empty() ? calibrated : drive_of(options.nominal);
  if (!nominal) return nominal.error();
  return write_ros2_diff_drive_yaml(options.out, *nominal, *calibrated);
}

Result<Done> write_export(const ExportOptions& options) {
  const Progress progress = terminal_progress("export");
  if (options.to == "tum") {
    const Result<Track> track = track_of(options.source, progress);
    if (!track) return track.error();
    if (!progress(0.9)) return stopped(options.out);
    return write_tum(options.out, *track);
  }
  if (options.to == "plotjuggler") {
    const Result<ImportedRecording> loaded = load_recording(options.source, progress);
    if (!loaded) return loaded.error();
    if (!progress(0.9)) return stopped(options.out);
    return write_plotjuggler_csv(options.out, loaded->recording);
  }
  if (options.to == "diff_drive_controller") return write_yaml(options);
  return Error{"--to", "'" + options.to + "'", "tum, plotjuggler or diff_drive_controller"};
}

int execute_export(const ExportOptions& options) {
  if (const std::optional<Error> unusable = unusable_output({options.out}, {options.source, options.nominal}))
    return bad_input(*unusable);
  const Result<Done> done = write_export(options);
  if (!done) return bad_input(done.error());
  std::printf("%s\n", name_of_output(options.out).c_str());
  return kDone;
}

}  // namespace

Command export_command() {
  const auto options = std::make_shared<ExportOptions>();
  Command command;
  command.name = "export";
  command.about =
      "Writes what other tools read: TUM trajectories (evo), PlotJuggler's CSV, diff_drive_controller's YAML";
  command.example =
      "odolab export run.csv --to tum --out truth.tum\n"
      "  odolab export calibrated.toml --nominal robot.toml --to diff_drive_controller --out drive.yaml";
  command.declare = [options](Arguments& arguments) {
    arguments.file("SOURCE", options->source, "a recording or track (tum), a recording (plotjuggler), a vehicle");
    arguments.option("--to", options->to, "tum, plotjuggler or diff_drive_controller", true);
    arguments.output("--out", options->out, "the file to write", true);
    arguments.option(
        "--nominal", options->nominal,
        "diff_drive_controller: the vehicle before it was calibrated; its lengths stay, the rest goes into "
        "the multipliers");
  };
  command.execute = [options] { return execute_export(*options); };
  return command;
}

}  // namespace odolab
