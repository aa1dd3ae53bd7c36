// By how much the frame of a truth's headings may be turned, slowly, without its likelihood showing it.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// No tracker's errors are all white: beside what the heading of one sample errs by, its frame is turned by a quarter of
// that, for so long to one side and then to the other. (Of a body with markers 0.15 m apart whose places in the room
// are known to 0.3 mm it is 2 mrad.)
constexpr double kTurnedOfOneSample = 0.25, kTurnedFor_s = 20.0;

// That much of a run's samples as they were recorded, of which each now counts for several.
inline double truth_turned_rad(const InnovationRun& run, const FittedNoise& noise) {
  return kTurnedOfOneSample * std::sqrt(run.samples_averaged) * noise.truth_heading_rad;
}

// What is left of it in the mean over all runs; of each as many independent ones as it has times of twice that length,
// and one at least. None where the frame's turns are carried beside the pose (FittedNoise::wander_lasts_s).
inline double mean_truth_turned_rad(const JointModel& joint) {
  if (joint.model.noise.wander_lasts_s > 0.0) return 0.0;
  double weights = 0.0, squares = 0.0;
  for (const InnovationRun& run : joint.runs()) {
    if (!run.truth_has_heading || run.truth.size() < 2) continue;
    const double lasts_s = run.truth.back().time_s - run.truth.front().time_s,
                 of_run_rad = truth_turned_rad(run, joint.model.noise);
    weights += lasts_s;
    squares += lasts_s * lasts_s * of_run_rad * of_run_rad / std::max(1.0, lasts_s / (2.0 * kTurnedFor_s));
  }
  return weights > 0.0 ? std::sqrt(squares) / weights : 0.0;
}

}  // namespace odolab
