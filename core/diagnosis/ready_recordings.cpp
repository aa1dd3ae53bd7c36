#include "core/diagnosis/ready_recordings.h"

#include "core/calibration/correlated_truth.h"
#include "core/calibration/recording_fault.h"
#include "core/diagnosis/model/ready_run.h"

namespace odolab {

Result<ReadyRecordings> ready_recordings(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                         const Vehicle& nominal, const Progress& progress) {
  if (train.empty()) return Error{"recordings", "none", "one or more"};
  ReadyRecordings ready;
  const auto check = [&](const std::vector<Recording>& given,
                         std::vector<CheckedRecording>& into) -> std::optional<Error> {
    for (const Recording& r : given) {
      if (const std::vector<std::string> problems = problems_in(r); !problems.empty())
        return Error{r.name.empty() ? "recording" : r.name, "", problems.front()};
      into.push_back(checked(r, nominal));
    }
    return {};
  };
  if (const std::optional<Error> problem = check(train, ready.train)) return *problem;
  if (const std::optional<Error> problem = check(held_out, ready.held_out)) return *problem;
  std::vector<CheckedRecording*> each;
  for (std::vector<CheckedRecording>* of : {&ready.train, &ready.held_out})
    for (CheckedRecording& c : *of) each.push_back(&c);
  std::vector<Recording> all;
  for (const CheckedRecording* c : each) all.push_back(c->recording);
  for (const std::optional<Error>& fault : faults_in(all, nominal))
    if (fault) return *fault;
  const PutRight put_right = mountings_put_right(all, nominal, [&](double) { return goes_on(progress, 0.0); });
  for (const MovedMounting& m : put_right.moved) each[m.index]->recording = put_right.recordings[m.index];
  ready.moved = put_right.moved;

  std::vector<Recording> fitted;
  LeastSquaresOptions with_faults_left_out;
  for (const CheckedRecording& c : ready.train) {
    fitted.push_back(c.recording);
    with_faults_left_out.left_out.push_back(c.left_out_s);
    ready.from_commands = ready.from_commands || c.from_commands;
  }
  Result<LeastSquaresCalibration> calibration = calibrate_least_squares(
      fitted, nominal, with_faults_left_out, [&](double share) { return goes_on(progress, share); });
  if (!calibration) return calibration.error();
  ready.calibration = *std::move(calibration);
  for (CheckedRecording* c : each) {
    ready.warnings.insert(ready.warnings.end(), c->warnings.begin(), c->warnings.end());
    if (ready.calibration.truth_apart_s > 0.0)
      c->recording = with_truth_apart(c->recording, ready.calibration.truth_apart_s);
  }
  ready.warnings.insert(ready.warnings.end(), ready.calibration.warnings.begin(), ready.calibration.warnings.end());
  return ready;
}

Result<JointModel> calibrated_model(const ReadyRecordings& ready, const Vehicle& nominal) {
  std::vector<InnovationRun> runs;
  std::vector<char> commands;
  for (const CheckedRecording& c : ready.train) {
    Result<InnovationRun> run = ready_run(c, nominal);
    if (!run) return run.error();
    runs.push_back(*std::move(run));
    commands.push_back(c.from_commands);
  }
  JointModel joint(std::move(runs), commands, ready.calibration, nominal);
  joint.truth_noise_lasts = ready.calibration.truth_apart_s > 0.0;
  joint.linearise();
  joint.gate();
  joint.fit(3);
  joint.fit_noise_and_all();
  return joint;
}

}  // namespace odolab
