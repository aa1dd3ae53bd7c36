#include <algorithm>
#include <cmath>

#include "app/cli/command.h"
#include "app/cli/file_examples.h"
#include "app/cli/internal_calibration.h"
#include "app/cli/overwriting.h"
#include "app/cli/parameter_table.h"
#include "app/cli/terminal.h"
#include "core/calibration/external.h"
#include "core/calibration/internal.h"
#include "core/calibration/left_out.h"
#include "core/calibration/odd_recordings.h"
#include "core/calibration/truth_filter.h"
#include "core/calibration/used_truth.h"
#include "core/diagnosis/given_recordings.h"
#include "core/diagnosis/quality/sound_recordings.h"
#include "core/geometry/begins_anew.h"
#include "core/io/import/imported_recording.h"
#include "core/io/vehicle_toml.h"
#include "core/io/window_words.h"
#include "core/odometry/prediction.h"

namespace odolab {

namespace {

struct CalibrateOptions {
  std::string vehicle;
  std::vector<std::string> recordings;
  std::string out;
};

// Root mean square over recordings of the pose error gathered over a metre, or to the truth's next pose, but for what
// was left out of each and what of its truth the calibration set aside.
struct PerMetre {
  double position_sum = 0.0, heading_sum = 0.0;
  int recordings = 0;
  std::vector<WindowSize> windows;

  void add(const Recording& recording, const Vehicle& vehicle, const TimeStretches& left_out, const UsedTruth& truth) {
    const Result<Track> track = predicted_track(recording, vehicle);
    if (!track) return;
    TimeStretches on_its_clock = left_out;
    for (auto& [from_s, to_s] : on_its_clock)
      from_s += vehicle.truth.time_offset_s, to_s += vehicle.truth.time_offset_s;
    std::vector<char> anew = begins_anew(truth.track, on_its_clock);
    for (std::size_t i = 0; i < anew.size(); ++i) anew[i] |= truth.anew[i];
    const auto error = track_error(*track, truth.track, anew);
    if (!error) return;
    position_sum += error->position_rms_m * error->position_rms_m;
    heading_sum += error->heading_rms_rad * error->heading_rms_rad;
    ++recordings;
    const std::vector<WindowSize> of_it = window_sizes(*track, *error);
    windows.insert(windows.end(), of_it.begin(), of_it.end());
  }
  double position_rms_m() const { return recordings > 0 ? std::sqrt(position_sum / recordings) : 0.0; }
  std::string text() const {
    if (recordings == 0) return "not to be had: the truth has no heading, or does not lie within the recording";
    return text_of("%.2f mm, %.3f degrees", 1e3 * position_rms_m(), degrees(std::sqrt(heading_sum / recordings)));
  }
};

// Of a recording of which the truth's clock was fitted by itself.
Vehicle by_its_own_clock(Vehicle vehicle, const ExternalCalibration& fitted, std::size_t recording) {
  const std::vector<double>& clocks = fitted.parts.front().calibration.time_offset_s;
  if (fitted.parts.size() == 1 && recording < clocks.size()) vehicle.truth.time_offset_s = clocks[recording];
  return vehicle;
}

// Calibrates without each recording in turn and predicts the one left out, by the clock that it has `of_all`.
PerMetre held_out_in_turn(const std::vector<Recording>& recordings, const Vehicle& nominal,
                          const LeastSquaresOptions& how, const ExternalCalibration& of_all,
                          const std::vector<UsedTruth>& truth) {
  PerMetre held_out;
  for (std::size_t left_out = 0; left_out < recordings.size() && !interrupted(); ++left_out) {
    const auto without = [left_out](auto all) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(left_out));
      return all;
    };
    LeastSquaresOptions of_others = how;
    of_others.left_out = without(how.left_out);
    const Result<ExternalCalibration> fitted =
        calibrate_externally(without(recordings), nominal, until_interrupted(), of_others);
    if (fitted)
      held_out.add(recordings[left_out], by_its_own_clock(fitted->vehicle, of_all, left_out),
                   how.left_out_of(left_out).value_or(TimeStretches{}), truth[left_out]);
  }
  return held_out;
}

// Of several recordings: those that do not go with the others, and whether what is learned from some serves the others.
std::vector<std::string> warnings_of_several(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                             const LeastSquaresOptions& how, const PerMetre& before,
                                             const PerMetre& held_out) {
  constexpr double kWorse = 1.05;  // what was right before errs by a little noise more
  std::vector<std::string> warnings, names;
  for (const Recording& recording : recordings) names.push_back(recording.name);
  for (const OddRecording& odd : odd_recordings(recordings, nominal, how, until_interrupted()))
    warnings.push_back(in_words(odd, names));
  if (held_out.recordings > 0 && held_out.position_rms_m() > kWorse * before.position_rms_m())
    warnings.push_back(
        text_of("each recording predicted from the others errs by %.2f mm, without any calibration by "
                "%.2f mm: no such parameters fit all of these recordings",
                1e3 * held_out.position_rms_m(), 1e3 * before.position_rms_m()));
  return warnings;
}

void print_calibration(const LeastSquaresCalibration& calibration) {
  print_parameters(calibration.parameters);
  std::printf("\nnoise: %.2f mm per root metre on each wheel; truth %.2f mm",
              1e3 * calibration.noise.wheel_m_per_sqrt_m, 1e3 * calibration.noise.truth_position_m);
  if (calibration.noise.truth_heading_rad > 0.0)
    std::printf(", %.3f degrees", degrees(calibration.noise.truth_heading_rad));
  std::printf("\nnormalised chi2 of the innovations: %.3f before, %.3f after, on %d of them (%d outliers set aside)\n",
              calibration.normalised_chi2_nominal, calibration.normalised_chi2, calibration.innovations,
              calibration.outliers);
  std::printf("the noise is fitted, too: whether it is noise, or physics that the model lacks, odolab diagnose says\n");
  for (const std::string& sentence : calibration.cannot_tell) std::printf("cannot tell: %s\n", sentence.c_str());
}

bool has_truth(const Recording& recording) { return truth_samples(recording).size() > 1; }

int execute_calibrate(const CalibrateOptions& options) {
  std::vector<std::string> inputs = options.recordings;
  inputs.push_back(options.vehicle);
  if (const std::optional<Error> unusable = unusable_output({options.out}, inputs)) return bad_input(*unusable);
  const Result<Vehicle> nominal = read_vehicle(options.vehicle);
  if (!nominal) return bad_input(nominal.error());
  const bool from_outside = can_calibrate_externally(*nominal), from_inside = can_calibrate_internally(*nominal);
  if (!from_outside && !from_inside)
    return bad_input({"kind", "'" + kind_name(*nominal) + "'",
                      "a kind that can be calibrated: not a synchro drive, which "
                      "`reproduce k2a-calibration` shows by its squares"});
  std::vector<Recording> recordings;
  for (const std::string& path : options.recordings) {
    Result<ImportedRecording> loaded = load_recording(path, until_interrupted());
    if (!loaded) return bad_input(loaded.error());
    for (const std::string& warning : loaded->warnings) print_message("warning: " + path + ": " + warning);
    if (const std::optional<Error> unknown = ticks_of_unknown_size(loaded->recording, *nominal, path))
      return bad_input(*unknown);
    recordings.push_back(std::move(loaded->recording));
  }
  if (const auto* drive = std::get_if<DifferentialDrive>(&nominal->kind))
    for (std::size_t i = 0; i < recordings.size(); ++i)
      if (wheel_samples(recordings[i], *drive).empty() && !command_samples(recordings[i]).empty())
        return bad_input({options.recordings[i], "commands alone",
                          "wheel rotation: how a base follows its commands is not calibrated yet"});
  if (const std::optional<Error> twice = given_twice(recordings, options.recordings)) return bad_input(*twice);
  // What both ways can calibrate is calibrated by the truth, where there is one.
  const bool by_truth = from_outside && (!from_inside || std::all_of(recordings.begin(), recordings.end(), has_truth));
  if (!by_truth) return calibrate_from_inside(recordings, *nominal, options.out);
  SoundRecordings sound = sound_recordings(std::move(recordings), *nominal, until_interrupted());
  for (const std::string& fault : sound.said) print_message("warning: " + fault);
  if (interrupted()) return stopped_before_its_end();
  recordings = std::move(sound.recordings);
  LeastSquaresOptions& how = sound.how;
  const Result<ExternalCalibration> calibration =
      calibrate_externally(recordings, *nominal, terminal_progress("calibrating"), how);
  if (!calibration) return bad_input(calibration.error());
  if (const std::optional<TruthFilter> filter = calibration->parts.front().calibration.truth_filter) {
    for (Recording& recording : recordings) recording = unfiltered_truth(recording, *filter);
    how.truth_is_unfiltered = true;
  }
  bool anything = false;
  for (const CalibratedPart& part : calibration->parts)
    for (const ParameterEstimate& p : part.calibration.parameters) anything = anything || p.determined;
  PerMetre before, after, held_out;
  std::vector<UsedTruth> truth;
  for (std::size_t i = 0; i < recordings.size() && anything; ++i) {
    const TimeStretches left_out = how.left_out_of(i).value_or(TimeStretches{});
    truth.push_back(used_truth(recordings[i], calibration->parts.front().calibration, i, how));
    before.add(recordings[i], *nominal, left_out, truth[i]);
    after.add(recordings[i], by_its_own_clock(calibration->vehicle, *calibration, i), left_out, truth[i]);
  }
  std::vector<std::string> of_several;
  if (anything && recordings.size() > 1) {
    held_out = held_out_in_turn(recordings, *nominal, how, *calibration, truth);
    of_several = warnings_of_several(recordings, *nominal, how, before, held_out);
  }
  if (interrupted()) return stopped_before_its_end();
  if (!options.out.empty() && anything)
    if (Result<Done> written = write_vehicle(options.out, calibration->vehicle); !written)
      return bad_input(written.error());

  for (const CalibratedPart& part : calibration->parts) {
    if (!part.name.empty()) std::printf("%s%s\n", &part == &calibration->parts.front() ? "" : "\n", part.name.c_str());
    print_calibration(part.calibration);
  }
  if (!anything) return nothing_determined(options.out);
  std::printf("\nerror gathered %s (dead reckoning against truth)\n", over_which_way(median_of(after.windows)).c_str());
  std::vector<std::vector<std::string>> rows{{"before", before.text()}, {"after", after.text()}};
  if (recordings.size() > 1) rows.push_back({"after, each recording predicted from the others", held_out.text()});
  print_table(rows);
  for (const std::string& warning : of_several) print_message("warning: " + warning);
  for (const CalibratedPart& part : calibration->parts)
    for (const auto* warnings : {&part.calibration.warnings, &part.calibration.of_misfit})
      for (const std::string& warning : *warnings)
        print_message("warning: " + part.name + (part.name.empty() ? "" : ": ") + warning);
  if (!options.out.empty()) std::printf("\nwritten: %s\n", name_of_output(options.out).c_str());
  return kDone;
}

}  // namespace

Command calibrate_command() {
  const auto options = std::make_shared<CalibrateOptions>();
  Command command;
  command.name = "calibrate";
  command.about = "Estimates a vehicle's parameters, with their uncertainty, from recordings with outside truth";
  command.example = "odolab calibrate --vehicle labmate.toml run-1.csv run-2.csv --out calibrated.toml";
  command.files = kVehicleAndRecordings;
  command.declare = [options](Arguments& arguments) {
    arguments.option("--vehicle", options->vehicle, "the vehicle as it is believed to be (TOML)", true);
    arguments.files("RECORDING", options->recordings, "one run each; OdoLab's CSV or a format that import knows", true);
    arguments.output("--out", options->out, "the calibrated vehicle to write (TOML)");
  };
  command.execute = [options] { return execute_calibrate(*options); };
  return command;
}

}  // namespace odolab
