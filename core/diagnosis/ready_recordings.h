// The recordings of a diagnosis, checked and put right, and what calibration alone makes of those that it is fitted to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/least_squares.h"
#include "core/calibration/left_out.h"
#include "core/calibration/moved_mounting.h"
#include "core/calibration/restamped.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/quality/quality.h"

namespace odolab {

// Where wheels and truth are beyond doubt timed by clocks that run apart (naming/clocks_first.h).
struct ClocksPutRight {
  std::vector<AlignedClock> clocks;           // of each recording that was fitted
  std::vector<AlignedClock> held_out_clocks;  // of the others
  LeastSquaresCalibration calibration;        // once these are right
};

struct ReadyRecordings {
  std::vector<CheckedRecording> train, held_out;  // truth thinned where its noise lasts
  std::vector<MovedMounting> moved;               // of both, the train first
  LeastSquaresCalibration calibration;            // of the train, by the clocks as they are
  std::optional<ClocksPutRight> clocks_put_right;
  bool from_commands = false;  // any of the train
  bool truth_jumps = false;    // time and again: left out, and no moment by itself says anything
  std::vector<std::string> warnings;

  // Where the fit begins, by the clocks as they are; but what the recordings tell, and how well, once these are right:
  // clocks that run apart hide that.
  LeastSquaresCalibration told() const;
  const LeastSquaresCalibration& by_right_clocks() const {
    return clocks_put_right ? clocks_put_right->calibration : calibration;
  }
};

// A recording by the calibration and by right clocks, as its faults are looked for.
struct KnownRun {
  InnovationRun run;
  InnovationModel model;
  TwoClocks clocks;
  TimeStretches as_stamped(TimeStretches on_right_clock) const;  // as the recording has them
};
// Number `r` of the train and those held out. None where it is no run.
std::optional<KnownRun> known_run(const ReadyRecordings& ready, const CheckedRecording& recording, std::size_t r,
                                  const Vehicle& nominal);

// Of a differential drive's recordings. An error where one is no recording, cannot be calibrated on, or `progress`
// stops it. `truth_is_white`: as of LeastSquaresOptions. `also_left_out_s`: of each, those that are fitted first, on
// the wheels' clock. `right_older_s`: than the left wheel's counts, which is put right once the counters' faults are
// found: these are looked for in whole counts.
Result<ReadyRecordings> ready_recordings(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                         const Vehicle& nominal, const Progress& progress, bool truth_is_white = false,
                                         const std::vector<TimeStretches>& also_left_out_s = {},
                                         double right_older_s = 0.0);

// All that were fitted under their calibration, with their noise, and no effect yet. `truth_may_come_back`: whether it
// is asked after how long the truth's frame does (JointModel::truth_may_come_back).
Result<JointModel> calibrated_model(const ReadyRecordings& ready, const Vehicle& nominal,
                                    bool truth_may_come_back = true);

}  // namespace odolab
