// Every estimator of the vehicle beside the run, on the same readings: its track, and its gap to the truth over time.
#pragma once

#include <memory>
#include <vector>

#include "app/gui/kept_rows.h"
#include "core/geometry/track.h"
#include "core/odometry/estimators.h"
#include "physics/simulation.h"

namespace odolab {

struct RunEstimate {
  std::string name, about;
  Track track;                // a pose for each sample of the encoders that is kept
  Pose gap;                   // estimate as seen from the truth, at the last sample
  std::vector<double> gap_m;  // at every picture that is kept
  std::vector<double> heading_rad;
};

class RunEstimates {
 public:
  // Begins at the simulation's start, of whose first sample it takes the readings.
  RunEstimates(const Scenario& scenario, const Simulation& simulation);

  void take(const Simulation& simulation);             // after each sample
  void remember();                                     // at each picture
  void keep_pictures(const std::vector<bool>& stays);  // of those remembered

  // The true poses at the times of the estimates' tracks. Of samples that are minutes old every eighth is kept: at the
  // usual 50 a second 0.16 s apart, between which a track may be taken as straight. From half an hour on it is every
  // sixteenth, from an hour on every thirty-second, so that a track never has more than about 16 000 poses.
  const Track& truth() const { return truth_; }
  const std::vector<RunEstimate>& all() const { return estimates_; }
  // The one that the vehicle itself steers by.
  std::size_t steering() const { return steering_; }

 private:
  std::vector<std::unique_ptr<RunningEstimator>> running_;
  std::vector<RunEstimate> estimates_;
  std::size_t steering_ = 0;
  Track truth_;
  KeptRows kept_{8, 16000};  // samples
};

}  // namespace odolab
