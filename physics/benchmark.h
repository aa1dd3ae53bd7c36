// The UMBmark experiment in the planar world: the square path several times in each direction.
#pragma once

#include <functional>

#include "core/base/progress.h"
#include "core/calibration/umbmark.h"
#include "core/scenario/scenario.h"

namespace odolab {

// A return position error with the run it belongs to.
struct BenchmarkRun {
  bool clockwise = false;
  int number = 0;
  ReturnError error;
};

// Called after each run, in their order: cw 1, ccw 1, cw 2, ...
using OnBenchmarkRun = std::function<void(const BenchmarkRun&)>;

// Drives the scenario's square `runs_each_way` times in each direction, every run on its own stretch of random floor.
// Stops early where `progress` says so; then the sets are shorter.
UmbmarkRuns run_umbmark(const Scenario& scenario, std::uint64_t seed, const OnBenchmarkRun& on_run = {}, const Progress& progress = {});

}  // namespace odolab
