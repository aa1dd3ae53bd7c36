// The automated self-calibration that the UMBmark report announces (section 7.3): the robot stands in an L-shaped
// corner, measures itself by sonar, drives its squares in both directions without being put back, calibrates, and stops
// by itself. A person only reads a tape measure once, for the scale.
#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/calibration/scale.h"
#include "physics/benchmark.h"

namespace odolab {

struct SelfCalibrationPlan {
  int runs_each_way = 5;
  int most_rounds = 3;        // squares in both directions, then a compensation; ends early by the rule of 3 SEM
  double approach_m = 0.5;    // before each square the robot drives to a point so far behind its start, then straight
                              // up to it: that sets its heading
  double tape_drive_m = 4.0;  // the one straight drive that a person measures; 0: nobody does
  double tape_accuracy_m = 0.002;  // standard deviation of that reading
};

struct SelfCalibrationRound {
  DifferentialDrive nominal;  // that it was driven with
  UmbmarkRuns runs;
  UmbmarkMeasure measure;
  std::optional<UmbmarkCalibration> calibration;  // none in a round that only confirms
};

struct SelfCalibration {
  std::vector<SelfCalibrationRound> rounds;
  std::optional<ScaleCalibration> scale;  // none where nobody measured
  DifferentialDrive found;
  double driven_m = 0.0;  // all the way, home-coming included
  double duration_s = 0.0;
  double farthest_from_corner_m = 0.0;  // of the places where it stopped to measure itself: what the sonar must reach
  bool lost = false;                    // it did not come home
};

// The scenario's path is a square; its vehicle is what the robot believes at first. Nothing is known to it but its
// encoders and what its sonar says where it stands: the scenario's truth noise. Nothing where `progress` stopped it.
std::optional<SelfCalibration> self_calibrate(const Scenario& scenario, const SelfCalibrationPlan& plan,
                                              std::uint64_t seed, const Progress& progress = {});

}  // namespace odolab
