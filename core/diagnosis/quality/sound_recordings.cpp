#include "core/diagnosis/quality/sound_recordings.h"

#include <cmath>

#include "core/calibration/external.h"
#include "core/calibration/moved_mounting.h"
#include "core/diagnosis/quality/bridged_recording.h"

namespace odolab {

namespace {

Result<ExternalCalibration> calibrated_by(const BridgedRecording& bridged, const Vehicle& nominal,
                                          const Progress& progress) {
  LeastSquaresOptions how;
  how.left_out.emplace_back(bridged.left_out_s);
  return calibrate_externally({bridged.recording}, nominal, progress, how);
}

// What seems at fault by a clock that is not the truth's, looked for again by the one that the rest of the recording
// tells: a late truth drives on where wheels rest. As it was where nothing could be calibrated then.
BridgedRecording by_its_clock(BridgedRecording bridged, const Recording& recording, const Vehicle& nominal,
                              const Progress& progress) {
  constexpr double kFar_s = 0.05;  // as where a diagnosis checks again
  if (bridged.said.empty()) return bridged;
  const Result<ExternalCalibration> told = calibrated_by(bridged, nominal, progress);
  if (!told) return bridged;
  const double offset_s = told->parts.front().calibration.time_offset_s.front();
  if (std::abs(offset_s - nominal.truth.time_offset_s) <= kFar_s) return bridged;
  BridgedRecording again = bridged_recording(recording, nominal, Looks::at_truth_too, AlignedClock{offset_s});
  return again.said.empty() || calibrated_by(again, nominal, progress) ? again : bridged;
}

}  // namespace

SoundRecordings sound_recordings(std::vector<Recording> recordings, const Vehicle& nominal, const Progress& progress) {
  SoundRecordings sound;
  for (Recording& recording : recordings) {
    if (!goes_on(progress, 0.0)) return sound;
    BridgedRecording bridged =
        by_its_clock(bridged_recording(recording, nominal, Looks::at_truth_too), recording, nominal, progress);
    sound.how.left_out.emplace_back();
    if (!bridged.said.empty()) sound.how.left_out.back() = std::move(bridged.left_out_s);
    for (std::string& fault : bridged.said) sound.said.push_back(std::move(fault));
    recording = std::move(bridged.recording);
  }
  PutRight put_right = mountings_put_right(recordings, nominal, progress);
  for (const MovedMounting& m : put_right.moved) sound.said.push_back(m.recording + ": " + m.sentence());
  sound.recordings = std::move(put_right.recordings);
  return sound;
}

}  // namespace odolab
