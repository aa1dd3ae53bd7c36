#include "physics/confirmed_diagnosis.h"

#include "core/diagnosis/fitted_model.h"
#include "physics/driven_recording.h"
#include "physics/model_replay.h"

namespace odolab {

Result<Diagnosis> confirmed_diagnosis(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                      const Vehicle& nominal, const Progress& progress) {
  constexpr double kOfDiagnosis = 0.7;  // of the time
  Result<Diagnosis> diagnosis =
      diagnose(train, held_out, nominal, {}, [&](double share) { return goes_on(progress, kOfDiagnosis * share); });
  if (!diagnosis) return diagnosis.error();
  std::vector<Recording> all = train;
  all.insert(all.end(), held_out.begin(), held_out.end());
  const auto& noise_floor =
      diagnosis->held_out.noise_floor ? diagnosis->held_out.noise_floor : diagnosis->train.noise_floor;
  const Result<ModelReplay> replayed =
      replay_model(all, calibrated_model_of(*diagnosis), model_of(*diagnosis), noise_floor,
                   [&](double share) { return goes_on(progress, kOfDiagnosis + (1.0 - kOfDiagnosis) * share); });
  if (!replayed) return replayed.error();
  diagnosis->simulation = replayed->fit;
  for (const std::string& sentence : replayed->not_switched_on) diagnosis->warnings.push_back(sentence);
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
