// One case of the proof: a robot, what it drove, what is missing from its model, and the recordings of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/diagnosis/diagnosis.h"
#include "physics/experiments/concealed/driven_run.h"

namespace odolab::concealed {

enum class Kind { nothing, one, two, outside };

// By the significance that a fit which knows the form has for an effect beside calibration, in sigma.
enum class Level { strong, medium, weak };
double significance_of(Level level);
const char* name_of(Level level);

// What is asked for instead of drawn.
struct Wish {
  std::optional<Kind> kind;
  std::optional<Level> level;
  std::optional<bool> poor;
  std::vector<std::string> effects;
};

struct Run {
  RunPlan plan;
  DrivenRun driven;
  InnovationRun known;  // with the motion of each effect as extra columns: for the oracle
  Recording recording() const { return driven.recording; }
};

struct DrawnCase {
  std::uint64_t seed = 0;
  int number = 0;
  Kind kind = Kind::nothing;
  Level level = Level::medium;
  bool poor = false;  // squares alone
  DrawnRobot robot;
  std::vector<DrawnEffect> effects;
  std::vector<double> significance;  // of each effect on the given runs
  std::vector<Run> given, held_out;
  int thrown_away = 0;  // draws before this one that these drives could not show at this level

  InnovationModel truth() const;  // the true model, noise and all
};

// Case `number` of a seed. Kinds and levels come in turn, so that every dozen has the same share of each.
// Where `progress` stops it, what comes back is unfinished.
DrawnCase drawn_case(std::uint64_t seed, int number, const Wish& wish = {}, const Progress& progress = {});

// Writes a case for inspection: vehicle.toml as diagnosis gets it, a scenario and a recording for each run (the given
// ones by their names, the others with `held_out_` in front), and truth.txt, which says what is missing. Rolling noise
// and effects outside the catalogue are not part of the scenarios.
Result<Done> write_case(const DrawnCase& drawn, const std::string& folder);

}  // namespace odolab::concealed
