#include <algorithm>

#include "app/cli/command.h"
#include "app/cli/file_examples.h"
#include "app/cli/overwriting.h"
#include "app/cli/terminal.h"
#include "core/base/formatted.h"
#include "core/calibration/recording_fault.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/given_recordings.h"
#include "core/diagnosis/obeyed_commands.h"
#include "core/diagnosis/quality/bridged_recording.h"
#include "core/io/import/imported_recording.h"
#include "core/io/model_toml.h"
#include "core/io/track_csv.h"
#include "core/io/vehicle_toml.h"
#include "core/io/window_words.h"

namespace odolab {

namespace {

struct PredictOptions {
  std::string vehicle, model, recording, out;
};

// What the model knows of single recordings, of which this is none.
void warn_of_what_others_had(const FittedModel& model, const std::string& path) {
  std::string left_out;
  for (const FittedEffect& effect : model.effects)
    if (!effect.recording.empty())
      left_out += (left_out.empty() ? "" : ", ") + effect.active.effect + " in " + effect.recording;
  if (!left_out.empty())
    print_message("warning: " + path + ": not what the model was fitted on; left out: " + left_out);
  // A clock that is off by this much moves a robot that drives 1 m/s by a centimetre.
  constexpr double kClocksDiffer_s = 0.01;
  if (model.truth_clock_s.empty()) return;
  const auto [least, most] = std::minmax_element(model.truth_clock_s.begin(), model.truth_clock_s.end(),
                                                 [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most->second - least->second > kClocksDiffer_s)
    print_message(
        formatted("warning: %s: not what the model was fitted on, where truth was late by %.3f to %.3f s; "
                  "taken to be late by %.3f s",
                  path.c_str(), least->second, most->second, model.vehicle.truth.time_offset_s));
}

int execute_predict(const PredictOptions& options) {
  if (const std::optional<Error> unusable =
          unusable_output({options.out}, {options.recording, options.vehicle, options.model}))
    return bad_input(*unusable);
  const Result<Vehicle> vehicle = read_vehicle(options.vehicle);
  if (!vehicle) return bad_input(vehicle.error());
  const Result<ImportedRecording> loaded = load_recording(options.recording, until_interrupted());
  if (!loaded) return bad_input(loaded.error());
  if (const std::optional<Error> unknown = ticks_of_unknown_size(loaded->recording, *vehicle, options.recording))
    return bad_input(*unknown);
  FittedModel model{*vehicle, {}, {}, {}};
  if (!options.model.empty()) {
    Result<FittedModel> read = read_model(options.model);
    if (!read) return bad_input(read.error());
    if (Result<Done> same = fits(*read, *vehicle); !same)
      return bad_input({options.model + ": " + same.error().where, same.error().found, same.error().expected});
    model = std::move(*read);
  }
  for (const std::string& warning : loaded->warnings) print_message("warning: " + options.recording + ": " + warning);
  // What a calibration refuses is predicted all the same: a prediction claims nothing of the recording.
  if (const std::optional<Error> fault = fault_in(loaded->recording, *vehicle))
    print_message("warning: " + fault->message());
  if (interrupted()) return stopped_before_its_end();
  const BridgedRecording sound = bridged_recording(loaded->recording, *vehicle, Looks::at_wheels_alone);
  for (const std::string& fault : sound.said) print_message("warning: " + fault);
  const Recording recording = with_obeyed_commands(sound.recording, *vehicle, model.vehicle);
  if (interrupted()) return stopped_before_its_end();
  const std::optional<std::string> fitted_as = model.fitted_as(loaded->recording);
  if (!fitted_as) warn_of_what_others_had(model, options.recording);
  const std::string name = fitted_as.value_or("");
  const Result<Track> track = predicted_track(recording, model.vehicle_in(name), model.effects_in(name));
  if (!track) return bad_input(track.error());
  if (interrupted()) return stopped_before_its_end();
  if (Result<Done> written = write_track_csv(options.out, *track); !written) return bad_input(written.error());
  if (const std::vector<TruthSample> truth = truth_samples(loaded->recording);
      !truth.empty() && !truth.front().heading_rad)
    print_message("warning: " + options.recording + ": its truth begins without a heading; the track begins with 0");
  std::printf("%s: %zu poses over %.1f s\n", name_of_output(options.out).c_str(), track->size(),
              track->back().time_s - track->front().time_s);
  if (const auto error = track_error(*track, truth_track(loaded->recording))) {
    // Diagnosis and calibration set aside what contradicts its neighbours; a prediction has looked at none of it.
    std::printf(
        "against the recorded truth: %.2f mm and %.3f degrees %s, %.1f mm at the end; every pose of it counts\n",
        1e3 * error->position_rms_m, degrees(error->heading_rms_rad),
        over_which_way(median_of(window_sizes(*track, *error))).c_str(), 1e3 * error->end_position_m);
  }
  return kDone;
}

}  // namespace

Command predict_command() {
  const auto options = std::make_shared<PredictOptions>();
  Command command;
  command.name = "predict";
  command.about = "Writes the track that a vehicle file predicts from a recording's encoders or commands alone";
  command.example = "odolab predict --vehicle labmate.toml --model fitted.toml run.csv --out track.csv";
  command.files = kVehicleAndRecordings;
  command.declare = [options](Arguments& arguments) {
    arguments.option("--vehicle", options->vehicle, "the vehicle (TOML)", true);
    arguments.option("--model", options->model, "calibration and effects that diagnose found on it (TOML)");
    arguments.file("RECORDING", options->recording, "the recording");
    arguments.output("--out", options->out, "the track to write (CSV)", true);
  };
  command.execute = [options] { return execute_predict(*options); };
  return command;
}

}  // namespace odolab
