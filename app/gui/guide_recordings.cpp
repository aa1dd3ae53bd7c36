// Recordings that are given to a guide, and what a calibration from the inside makes of them.
#include "app/gui/guide_desk.h"
#include "core/calibration/internal.h"
#include "core/guide/recorded_run.h"
#include "core/io/import/imported_recording.h"
#include "core/recording/vehicle_samples.h"

namespace odolab {

void GuideDesk::read_recordings(Jobs& jobs) {
  const auto read = [this](const std::vector<std::string>& files, std::vector<Recording>& recordings) {
    recordings.clear();
    for (const std::string& file : files) {
      const Result<ImportedRecording> recording = load_recording(file);
      if (recording)
        recordings.push_back(recording->recording);
      else
        problem_ = recording.error().message();
    }
  };
  read(session_->recordings, recordings_);
  read(session_->held_out, held_out_);
  calibrate_inside(jobs);
}

void GuideDesk::calibrate_inside(Jobs& jobs) {
  internal_.reset();
  reckon();
  if (recordings_.empty()) return;
  const Vehicle nominal = session_->vehicle;
  const std::vector<Recording> recordings = recordings_;
  const auto found = std::make_shared<std::optional<Result<InternalCalibration>>>();
  jobs.start(
      "calibrating from the inside",
      [nominal, recordings, found](const Progress& progress, const Jobs::Deliver&) {
        *found = calibrate_internally(recordings, nominal, progress);
      },
      [this, found](bool cancelled) {
        if (cancelled || !session_ || !*found) return;
        if (**found)
          internal_ = std::make_shared<const InternalCalibration>(***found);
        else
          problem_ = (*found)->error().message();
        reckon();
      });
}

Result<Done> GuideDesk::take(const std::string& path, const Recording& recording, Jobs& jobs) {
  if (!session_) return Done{};
  const PageTask page = task();
  if (page == PageTask::recordings) {
    if (jobs.running()) return Error{path, "a calibration under way", "it to be done first"};
    for (const std::string& known : session_->recordings)
      if (known == path) return Error{path, "a recording that is here already", "each once"};
    const std::string missing = missing_columns(recording, session_->vehicle);
    if (!missing.empty()) return Error{path, "no " + missing, "these columns"};
    remember();
    session_->recordings.push_back(path);
    recordings_.push_back(recording);
    changed_ = true;
    calibrate_inside(jobs);
    return Done{};
  }
  if (page == PageTask::held_out) {
    if (!outcome_.calibrated) return Error{path, "no calibration yet", "one to be held against it"};
    const Result<HeldOutError> error = held_out_error(recording, session_->vehicle, *outcome_.calibrated);
    if (!error) return error.error();
    remember();
    session_->held_out.push_back(path);
    held_out_.push_back(recording);
    changed_ = true;
    reckon();
    return Done{};
  }
  const GuideRound* round = round_on(*session_, page);
  if (!round || page == PageTask::verdict)
    return Error{path, "a recording", "it on the page on which the runs are entered"};
  Vehicle nominal = session_->vehicle;
  nominal.kind = round->runs.empty() && page != PageTask::again ? first_nominal(*session_) : round->nominal;
  const Result<GuideRun> run = run_in(recording, nominal);
  if (!run) return run.error();
  remember();
  enter_run(*session_, page, *run);
  changed_ = true;
  reckon();
  return Done{};
}

}  // namespace odolab
