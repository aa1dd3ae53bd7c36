// What the panels of a guide show, and what they ask for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/guide/outcome.h"
#include "core/scenario/scenario.h"
#include "ui/bench.h"

namespace odolab::ui {

// A session that can be gone on with.
struct SavedGuide {
  std::string path;
  std::string words;  // "UMBmark, LabMate"
  std::string where;  // "page 4 of 8, The runs"
};

struct GuideView {
  const GuideSession* session = nullptr;  // null: none is open, choose one
  const GuideOutcome* outcome = nullptr;
  std::vector<bool> misfits;                                  // of the page's round
  const std::vector<BenchExperiment>* experiments = nullptr;  // the rounds as the clusters are drawn
  std::vector<SavedGuide> saved;                              // the newest first
  std::vector<std::string> vehicle_files;                     // that come with the project
  std::string file;                                           // of the open session; empty: it is kept nowhere
  bool all_saved = true;
  std::string problem;  // with saving, or with what was dropped last
  bool busy = false;
  std::string job;
  double share_done = 0.0;
  std::string can_simulate;       // why not, empty: it can
  bool rough_floor = false;       // of a simulated robot
  std::optional<Vehicle> actual;  // the true machine of a simulated robot, for the result's last column
};

}  // namespace odolab::ui
