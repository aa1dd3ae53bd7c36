// The scenario that a person edits, kept on disk as it is edited: a crash or a kill loses at most the last second of
// it.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/scenario/scenario.h"

namespace odolab {

class EditedScenario {
 public:
  // With an empty path nothing is kept.
  explicit EditedScenario(std::string path) : path_(std::move(path)) {}

  // It was edited, or has come back by undo.
  void changed() { unsaved_ = !path_.empty(); }
  // Writes what has changed, soon after it has; whole or not at all.
  Result<Done> advance(double wall_s, const Scenario& scenario);
  // There is nothing to come back to: it was saved by its owner, or another scenario is open.
  void forget();

  const std::string& path() const { return path_; }
  // Whether an earlier window has left one.
  bool is_there() const;

 private:
  std::string path_;
  bool unsaved_ = false;
  double waited_s_ = 0.0;
};

}  // namespace odolab
