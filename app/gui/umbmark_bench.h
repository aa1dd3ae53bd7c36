// The benchmark in the window: experiments that follow one another, each with the vehicle that the last one found.
#pragma once

#include <vector>

#include "app/gui/jobs.h"
#include "core/scenario/scenario.h"
#include "ui/bench.h"

namespace odolab {

class UmbmarkBench {
 public:
  // Drives the scenario's square (a 4 m one where it has none) with its own nominal vehicle.
  void start(const Scenario& scenario, int runs_each_way, bool keep_things, Jobs& jobs);
  // Drives it again with the vehicle that the last experiment corrected. Does nothing without one.
  void apply(Jobs& jobs);
  void clear() { experiments_.clear(); }

  const std::vector<ui::BenchExperiment>& experiments() const { return experiments_; }
  const Scenario& scenario() const { return scenario_; }
  bool running() const { return running_; }
  // The vehicle that the last calibrated experiment was driven with, corrected ones included.
  const DifferentialDrive* kept_vehicle() const;

 private:
  void drive(const std::string& name, const DifferentialDrive& vehicle, Jobs& jobs);

  Scenario scenario_;
  std::vector<ui::BenchExperiment> experiments_;
  bool running_ = false;
};

}  // namespace odolab
