// What the panels of Calibrate show: one UMBmark experiment after the other, each with the vehicle it believed in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/umbmark.h"
#include "core/scenario/scenario.h"

namespace odolab::ui {

// A run in which the robot never arrived: it has no return error.
struct LostRun {
  bool clockwise = false;
  int number = 0;  // from 1 in each direction
};

struct BenchExperiment {
  std::string name;           // "uncalibrated", "after 1st calibration"
  DifferentialDrive vehicle;  // the nominal one it was driven with
  UmbmarkRuns runs;           // so far, those that arrived
  std::vector<LostRun> lost;  // without a calibration where there are any
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

// "cw 2 and ccw 3 never arrived"; empty where all did.
inline std::string words_of_lost(const std::vector<LostRun>& lost) {
  std::string words;
  for (std::size_t i = 0; i < lost.size(); ++i)
    words += (i == 0                 ? ""
              : i + 1 == lost.size() ? " and "
                                     : ", ") +
             std::string(lost[i].clockwise ? "cw " : "ccw ") + std::to_string(lost[i].number);
  return words.empty() ? words : words + " never arrived";
}

}  // namespace odolab::ui
