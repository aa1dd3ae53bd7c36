// The recordings of a diagnosis, checked and put right, and what calibration alone makes of those that it is fitted to.
#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/least_squares.h"
#include "core/calibration/left_out.h"
#include "core/calibration/moved_mounting.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/quality/quality.h"

namespace odolab {

struct ReadyRecordings {
  std::vector<CheckedRecording> train, held_out;  // truth thinned where its noise lasts
  std::vector<MovedMounting> moved;               // of both, the train first
  LeastSquaresCalibration calibration;            // of the train
  bool from_commands = false;                     // any of the train
  bool truth_jumps = false;                       // time and again: left out, and no moment by itself says anything
  std::vector<std::string> warnings;
};

// Of a differential drive's recordings. An error where one is no recording, cannot be calibrated on, or `progress`
// stops it. `truth_is_white`: as of LeastSquaresOptions. `also_left_out_s`: of each, those that are fitted first, on
// the wheels' clock.
Result<ReadyRecordings> ready_recordings(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                         const Vehicle& nominal, const Progress& progress, bool truth_is_white = false,
                                         const std::vector<TimeStretches>& also_left_out_s = {});

// All that were fitted under their calibration, with their noise, and no effect yet. `truth_may_come_back`: whether it
// is asked after how long the truth's frame does (JointModel::truth_may_come_back).
Result<JointModel> calibrated_model(const ReadyRecordings& ready, const Vehicle& nominal,
                                    bool truth_may_come_back = true);

}  // namespace odolab
