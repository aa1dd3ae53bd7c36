#include "physics/confirmed_diagnosis.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/evened_recording.h"
#include "core/diagnosis/fitted_model.h"
#include "core/diagnosis/mismatch.h"
#include "core/diagnosis/refuted.h"
#include "core/recording/truth_left_out.h"
#include "physics/driven_recording.h"
#include "physics/model_replay.h"

namespace odolab {

namespace {

// Where stamps tremble, wheels that are turned by them are jerked until they slip.
Recording with_even_stamps(const Recording& recording, const Vehicle& nominal) {
  const auto* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  std::optional<EvenedRecording> even;
  if (drive) even = evened(recording, *drive);
  return even ? std::move(even->recording) : recording;
}

// On the truth's clock, and a reading wider at either end.
WaysUnknown ways_unknown(const Diagnosis& diagnosis, const FittedModel& model) {
  constexpr double kWider_s = 0.1;
  WaysUnknown unknown;
  for (const Finding& f : diagnosis.findings)
    if (f.effect == "encoder_data_fault")
      for (const auto& [from_s, to_s] : f.where.time_s) {
        const double late_s = model.vehicle_in(f.where.recording).truth.time_offset_s;
        unknown[f.where.recording].emplace_back(from_s + late_s - kWider_s, to_s + late_s + kWider_s);
      }
  return unknown;
}

}  // namespace

Recording with_truth_that_was_used(Recording recording, const Diagnosis& diagnosis) {
  constexpr double kSame_s = 1e-6;
  const Residuals* residuals = of_recording(diagnosis.residuals_before, recording.name);
  if (!residuals) return recording;
  const std::vector<double>& used_s = residuals->time_s;
  const Channel* x = recording.channel("truth_x_m");
  if (!x || used_s.empty()) return recording;
  std::vector<char> unused(recording.time_s.size(), 0);
  std::size_t found = 0;
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    if (std::isnan(x->values[i])) continue;
    const auto at = std::lower_bound(used_s.begin(), used_s.end(), recording.time_s[i] - kSame_s);
    const bool is_used = at != used_s.end() && *at <= recording.time_s[i] + kSame_s;
    unused[i] = !is_used;
    found += is_used;
  }
  if (2 * found < used_s.size()) return recording;  // their stamps are others
  leave_truth_out(recording, unused);
  return recording;
}

Result<Diagnosis> confirmed_diagnosis(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                      const Vehicle& nominal, const Progress& progress) {
  constexpr double kOfDiagnosis = 0.7;  // of the time
  Result<Diagnosis> diagnosis =
      diagnose(train, held_out, nominal, {}, [&](double share) { return goes_on(progress, kOfDiagnosis * share); });
  if (!diagnosis) return diagnosis.error();
  std::vector<Recording> all;
  for (const Recording& recording : train)
    all.push_back(with_truth_that_was_used(with_even_stamps(recording, nominal), *diagnosis));
  for (const Recording& recording : held_out) all.push_back(with_even_stamps(recording, nominal));
  const auto& noise_floor =
      diagnosis->held_out.noise_floor ? diagnosis->held_out.noise_floor : diagnosis->train.noise_floor;
  const FittedModel before = calibrated_model_of(*diagnosis);
  const Result<ModelReplay> replayed = replay_model(
      all, nominal, before, model_of(*diagnosis), noise_floor,
      [&](double share) { return goes_on(progress, kOfDiagnosis + (1.0 - kOfDiagnosis) * share); },
      ways_unknown(*diagnosis, before));
  if (!replayed) return replayed.error();
  diagnosis->simulation = replayed->fit;
  for (const std::string& sentence : replayed->not_switched_on) diagnosis->warnings.push_back(sentence);
  if (!simulator_follows(*diagnosis))
    diagnosis->warnings.push_back(
        "the simulator, driven by these recordings, errs by more than twice what the calibrated model does: it does "
        "not "
        "go the same ways, or all that it is held against are poses at the ends, and so it neither confirms nor "
        "refutes");
  return diagnosis;
}

Result<Diagnosis> diagnosed(const Mystery& mystery, const Progress& progress) {
  constexpr double kOfDriving = 0.3;  // of the time
  std::vector<Recording> recordings;
  const double all = static_cast<double>(mystery.drives.size());
  for (const Scenario& drive : mystery.drives) {
    const double before = static_cast<double>(recordings.size());
    const auto recording = driven_recording(
        drive, drive.seed, [&](double share) { return goes_on(progress, kOfDriving * (before + share) / all); });
    if (!recording) return Error{drive.name, "a run that did not arrive", "one driven to the end"};
    recordings.push_back(*recording);
  }
  return diagnose(recordings, {}, mystery.drives.front().vehicle, {},
                  [&](double share) { return goes_on(progress, kOfDriving + (1.0 - kOfDriving) * share); });
}

}  // namespace odolab
