// Where a person stands in a guide and all that they have entered: a plain struct that is saved as it grows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/scale.h"
#include "core/calibration/umbmark.h"
#include "core/guide/guide.h"

namespace odolab {

// One square: where the robot's odometry says it ended, and where it really stands. Both in the frame of the start
// mark: x forward along the first side, y to the left.
struct GuideRun {
  bool clockwise = true;
  Pose odometry;
  Pose measured;
  bool has_heading = false;  // nobody must measure it for UMBmark; extended UMBmark is about nothing else
  bool left_out = false;     // by the person; it stays in the record and in the report
  std::string source;        // "typed", "simulated", or the recording's name
};

// Absolute minus calculated (Eq. 3.1).
ReturnError return_error(const GuideRun& run);

// Squares that were driven with the same settings.
struct GuideRound {
  DifferentialDrive nominal;  // what the odometry worked with
  std::vector<GuideRun> runs;
  int lost = 0;  // simulated runs in which the robot never came home
};

struct GuideSession {
  GuideKind kind = GuideKind::umbmark;
  bool real_robot = true;
  int page = 0;     // counted from 0
  int reached = 0;  // the furthest page so far
  Vehicle vehicle;  // as the robot believed when the guide began
  double side_m = 4.0;
  int runs_each_way = 5;
  std::optional<TapeReading> tape;
  GuideRun draft;                       // the run that is being typed
  std::vector<GuideRound> rounds;       // the first uncalibrated; each next one with what the last one found
  GuideRound bumped;                    // extended UMBmark: over the bumps
  std::vector<std::string> recordings;  // files
  std::vector<std::string> held_out;    // files that the calibration does not see
};

// The settings that the first round is driven with: the vehicle's, with the tape's scale put in.
DifferentialDrive first_nominal(const GuideSession& session);

// The round that a page enters runs into; null for pages without runs. The first round of runs is made by the first
// run.
const GuideRound* round_on(const GuideSession& session, PageTask task);

// Enters a run into the round of the page's task. The first run of a round fixes the settings it was driven with.
void enter_run(GuideSession& session, PageTask task, const GuideRun& run);

// How many runs of a round count in a direction.
int counted(const GuideRound& round, bool clockwise);

// The direction in which the next run is due: they take turns, clockwise first.
bool next_is_clockwise(const GuideRound& round);

// Those that count, for calibrate_umbmark.
UmbmarkRuns umbmark_runs(const GuideRound& round, double side_m);

// Begins a further round with what the last one found: for the page "Once more" and for a second compensation. False
// where the last round calibrates nothing.
bool compensate(GuideSession& session);

// Turns to a page. The first visit to "Once more" begins the round that is driven with what the first one found.
void turn_to(GuideSession& session, int page);

// What must still be done on the page before the next one makes sense, in one sentence; empty where nothing.
std::string still_to_do(const GuideSession& session);

// Everything that makes a session unusable, as sentences: for files that somebody edited.
std::vector<std::string> problems_in(const GuideSession& session);

}  // namespace odolab
