// Recordings under the joint model as they calibrate their vehicle, fitted; nothing is let in yet.
#pragma once

#include <utility>
#include <vector>

#include "core/calibration/least_squares.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab::test {

inline JointModel calibrated_model(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  std::vector<InnovationRun> runs;
  for (const Recording& r : recordings) runs.push_back(innovation_run(r, nominal).value());
  JointModel joint(std::move(runs), std::vector<char>(recordings.size(), 0),
                   calibrate_least_squares(recordings, nominal).value(), nominal);
  joint.fit(4);
  return joint;
}

}  // namespace odolab::test
