#include "core/diagnosis/quality/sound_recordings.h"

#include "core/calibration/moved_mounting.h"
#include "core/diagnosis/quality/bridged_recording.h"

namespace odolab {

SoundRecordings sound_recordings(std::vector<Recording> recordings, const Vehicle& nominal, const Progress& progress) {
  SoundRecordings sound;
  for (Recording& recording : recordings) {
    if (!goes_on(progress, 0.0)) return sound;
    BridgedRecording bridged = bridged_recording(recording, nominal, Looks::at_truth_too);
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
