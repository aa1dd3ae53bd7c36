// Runs in which the tracked point sat elsewhere on the vehicle than in the others: a marker that was knocked or put on
// anew, a tracker's frame that was drawn anew.
#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

struct MovedMounting {
  std::size_t index = 0;  // of the recording
  std::string recording;
  Pose axle_T_tracked, stderrs;  // in this run
  Pose usual;                    // in the others, to which the truth was carried
  double log_likelihood_gain = 0.0;
  std::string sentence() const;
};

struct PutRight {
  std::vector<Recording> recordings;  // the truth of the runs that moved carried to where it was measured in the others
  std::vector<MovedMounting> moved;   // in the order of the recordings
};

// First by each run's own fit (`run_fit`), over the whole of it and over both halves; what stands out by more than
// 15 mm or 1.5 degrees and six sigma from the middle of all is then measured by calibrations of that run and of the
// others. Nothing is said where half or more of the runs stand out, of a run that cannot tell its mounting and its scale
// (a circle), nor of truth without headings. Of two runs that differ, the one further from the vehicle file is the one that moved.
PutRight mountings_put_right(const std::vector<Recording>& recordings, const Vehicle& nominal,
                             const Progress& progress = {});

}  // namespace odolab
