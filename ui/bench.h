// What the panels of Calibrate show: one UMBmark experiment after the other, each with the vehicle it believed in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/umbmark.h"
#include "core/scenario/scenario.h"

namespace odolab::ui {

struct BenchExperiment {
  std::string name;           // "uncalibrated", "after 1st calibration"
  DifferentialDrive vehicle;  // the nominal one it was driven with
  UmbmarkRuns runs;           // so far
  std::optional<UmbmarkMeasure> measure;
  std::optional<UmbmarkCalibration> calibration;         // once all runs are in
  double alpha_stderr_rad = 0.0, beta_stderr_rad = 0.0;  // of its exact type errors
  std::optional<OneDirectionCalibration> only_clockwise, only_counter_clockwise;
};

struct Bench {
  const std::vector<BenchExperiment>* experiments = nullptr;
  bool running = false;
  double share_done = 0.0;
  bool can_run = true;
  std::string why_not;
  double side_m = 4.0;
  bool rough = false;       // the floor lengthens the way of both wheels
  bool has_things = false;  // cables or patches lie on the floor
  std::string vehicle_name;
  ActualDrive actual;  // the truth, for the comparison that only a simulation allows
};

}  // namespace odolab::ui
