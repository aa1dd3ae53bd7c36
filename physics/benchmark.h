// The UMBmark experiment in the planar world: the square path several times in each direction.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/calibration/umbmark.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace odolab {

// A return position error with the run it belongs to.
struct BenchmarkRun {
  bool clockwise = false;
  int number = 0;  // from 1 in each direction
  ReturnError error;
  bool finished = false;  // false: the robot never arrived, and the error means nothing
  Recording recording;    // encoders, and the absolute pose at the start and the end
};

// Called after each run, in their order: cw 1, ccw 1, cw 2, ...
using OnBenchmarkRun = std::function<void(const BenchmarkRun&)>;

// Drives the scenario's square (or rectangle, of linked vehicles) `runs_each_way` times in each direction, every run on
// its own stretch of random floor. Stops early where `progress` says so; then the sets are shorter.
UmbmarkRuns run_umbmark(const Scenario& scenario, std::uint64_t seed, const OnBenchmarkRun& on_run = {},
                        const Progress& progress = {});

// One round of the experiment: the squares as driven with a nominal drive, and what they say about it.
struct UmbmarkStage {
  DifferentialDrive nominal;
  UmbmarkRuns runs;
  UmbmarkMeasure measure;
  std::optional<UmbmarkCalibration> calibration;  // that the next stage is driven with
};

// Section 6.3 of the report: drives uncalibrated, calibrates, drives again, and compensates a second time where the
// rule of 3 SEM says that this is worth while. Two or three stages; fewer where `progress` stopped it.
std::vector<UmbmarkStage> run_umbmark_calibration(const Scenario& scenario, std::uint64_t seed,
                                                  const OnBenchmarkRun& on_run = {}, const Progress& progress = {});

}  // namespace odolab
