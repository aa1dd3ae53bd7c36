// One run in the planar world as a recording, and the same wheels driven again without an effect: the difference is
// what the effect does, in the simulator's own physics.
#pragma once

#include <cstdint>
#include <vector>

#include "core/calibration/innovations.h"
#include "core/recording/recording.h"
#include "physics/experiments/concealed/drawn_drives.h"
#include "physics/experiments/concealed/drawn_effect.h"
#include "physics/experiments/concealed/drawn_robot.h"

namespace odolab::concealed {

// What is driven once. `effects` are those that act in this run.
struct RunPlan {
  DrawnRobot robot;
  DrawnDrive drive;
  std::vector<DrawnEffect> effects;
  bool noise = true;  // of floor and wheels; the truth's stays
  std::uint64_t seed = 1;
  double longest_s = 150.0;  // a run that has not arrived by then is cut off

  Scenario scenario() const;  // without what no scenario can name
  double clock_rate() const;  // of the robot's stamps
};

struct DrivenRun {
  Recording recording;
  Track true_axle;                   // at each step
  std::vector<WheelSample> counted;  // what encoders of endless resolution would count, at each step
};

DrivenRun driven(const RunPlan& plan);

// The axle's track at each step when the plan's world is driven by the wheels that were counted in a run.
Track driven_again(const RunPlan& plan, const std::vector<WheelSample>& counted);

// A track of a run, each step, and the rate by which the stamps of the wheels grow too fast against its clock.
struct StampedTrack {
  const Track& track;
  double clock_rate = 0.0;
};

// Body motion that `with` has and `without` has not, between wheel samples.
std::vector<BodyMotion> difference(const std::vector<WheelSample>& wheels, const StampedTrack& with,
                                   const StampedTrack& without);

}  // namespace odolab::concealed
