#include "physics/confirmed_diagnosis.h"

#include <algorithm>
#include <cmath>

#include "core/base/stamp_digits.h"
#include "core/calibration/evened_recording.h"
#include "core/calibration/left_out.h"
#include "core/diagnosis/fitted_model.h"
#include "core/diagnosis/mismatch.h"
#include "core/diagnosis/refuted.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/recording/truth_left_out.h"
#include "core/recording/vehicle_samples.h"
#include "physics/driven_recording.h"
#include "physics/model_replay.h"

namespace odolab {

namespace {

// Where stamps tremble, wheels that are turned by them are jerked until they slip.
Recording with_even_stamps(const Recording& recording, const Vehicle& nominal) {
  const auto* drive = std::get_if<DifferentialDrive>(&nominal.kind);
  const auto* tracks = std::get_if<Tracked>(&nominal.kind);
  const std::vector<std::string> encoders = encoder_columns(nominal);
  std::optional<EvenedRecording> even;
  if (drive || tracks)
    even = evened(recording, drive ? *drive : as_differential_drive(*tracks));
  else if (!encoders.empty())
    even = evened(recording, encoders);
  return even ? std::move(even->recording) : recording;
}

const JudgedPart* judged_of(const Diagnosis& diagnosis, const std::string& recording) {
  for (const JudgedPart& part : diagnosis.judged)
    if (part.recording == recording) return &part;
  return nullptr;
}

// Whether the truth looks on while the vehicle goes.
bool any_is_looked_at(const std::vector<Recording>& recordings) {
  constexpr std::size_t kAtTheEnds = 2;
  return std::any_of(recordings.begin(), recordings.end(),
                     [](const Recording& r) { return truth_samples(r).size() > kAtTheEnds; });
}

}  // namespace

WaysUnknown ways_unknown(const std::vector<Recording>& recordings, const Diagnosis& diagnosis,
                         const FittedModel& model) {
  constexpr double kWider_s = 0.1;
  WaysUnknown unknown;
  const auto add = [&](const std::string& recording, const TimeStretches& times) {
    const double late_s = model.vehicle_in(recording).truth.time_offset_s;
    for (const auto& [from_s, to_s] : times)
      unknown[recording].emplace_back(from_s + late_s - kWider_s, to_s + late_s + kWider_s);
  };
  for (const Finding& f : diagnosis.findings)
    if (f.effect == "encoder_data_fault" || f.is_parted) add(f.where.recording, f.where.time_s);
  for (const Recording& r : recordings) {
    if (const JudgedPart* judged = judged_of(diagnosis, r.name)) add(r.name, judged->way_unknown_s);
    std::vector<WheelSample> first;  // all units are read together
    for (const UnitSample& s : unit_samples(r, model.vehicle))
      first.push_back({s.time_s, s.wheels[0].left_rad, s.wheels[0].right_rad});
    if (first.size() > 1) add(r.name, encoder_gaps(first));
  }
  return unknown;
}

Recording with_truth_that_was_used(Recording recording, const Diagnosis& diagnosis) {
  const Residuals* residuals = of_recording(diagnosis.residuals_after, recording.name);
  const JudgedPart* judged = judged_of(diagnosis, recording.name);  // of those held out there are no residuals
  if (!residuals && !judged) return recording;
  const std::vector<double>& used_s = residuals ? residuals->time_s : judged->truth_s;
  const Channel* x = recording.channel("truth_x_m");
  if (!x || used_s.empty()) return recording;
  std::vector<char> unused(recording.time_s.size(), 0);
  std::size_t found = 0;
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    if (std::isnan(x->values[i])) continue;
    const auto at = std::lower_bound(used_s.begin(), used_s.end(), recording.time_s[i] - kStampDigits_s);
    const bool is_used = at != used_s.end() && *at <= recording.time_s[i] + kStampDigits_s;
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
  for (const auto* recordings : {&train, &held_out})
    for (const Recording& recording : *recordings)
      all.push_back(with_truth_that_was_used(with_even_stamps(recording, nominal), *diagnosis));
  const auto& noise_floor =
      diagnosis->held_out.noise_floor ? diagnosis->held_out.noise_floor : diagnosis->train.noise_floor;
  const FittedModel before = calibrated_model_of(*diagnosis);
  const Result<ModelReplay> replayed = replay_model(
      all, nominal, before, model_of(*diagnosis), noise_floor,
      [&](double share) { return goes_on(progress, kOfDiagnosis + (1.0 - kOfDiagnosis) * share); },
      ways_unknown(all, *diagnosis, before));
  if (!replayed) return replayed.error();
  diagnosis->simulation = replayed->fit;
  for (const std::string& sentence : replayed->not_switched_on) diagnosis->warnings.push_back(sentence);
  if (!simulator_follows(*diagnosis))
    diagnosis->warnings.push_back(
        std::string("the simulator, driven by these recordings, errs by more than twice what the calibrated model "
                    "does: ") +
        (any_is_looked_at(all) ? "it does not go the same ways" : "all that it is held against are poses at the ends") +
        ", and so it neither confirms nor refutes");
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
