// Recordings under the joint model as their vehicle's file is, for what depends on where they go and not on how well.
#pragma once

#include <utility>
#include <vector>

#include "core/calibration/least_squares.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab::test {

inline JointModel uncalibrated_model(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  std::vector<InnovationRun> runs;
  for (const Recording& r : recordings) runs.push_back(innovation_run(r, nominal).value());
  LeastSquaresCalibration as_it_is;
  as_it_is.vehicle = nominal;
  as_it_is.noise = {2e-4, 1e-3, 2e-3};
  JointModel joint(std::move(runs), std::vector<char>(recordings.size(), 0), as_it_is, nominal);
  joint.linearise();
  return joint;
}

}  // namespace odolab::test
