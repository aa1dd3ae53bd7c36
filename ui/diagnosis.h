// What the panels of Diagnose show: the runs, the answer, where the mismatch is, and what the simulation makes of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/mismatch.h"
#include "core/geometry/track.h"
#include "ui/diagnosis_actions.h"
#include "ui/floor/trail.h"
#include "ui/plot/plot.h"

namespace odolab::ui {

struct DiagnosedRun {
  std::string name, provenance;
  std::string truth;                // "6012 poses, 100 Hz", "12 poses, no headings"
  std::string problem;              // why it cannot be judged; then it is left out
  std::vector<std::string> notes;   // on how it came about
  std::vector<std::string> faults;  // of its data, a sentence each
  double duration_s = 0.0;
  bool held_out = false;
  bool simulated = false;  // by this window: no evidence about a real robot
  const Trail* way = nullptr;
  // Once it has been diagnosed; null before, and where nothing can be predicted of a run that was held out.
  const Trail* mismatch_trail = nullptr;
  const MismatchOverTime* mismatch = nullptr;
  // Those of the vehicle's that can be drawn, and which of them is: "truck_b"; empty: the one that tows.
  std::vector<std::string> units;
  std::string unit;
  std::vector<LocatedStretch> located;
  // The simulation driven by its inputs; null before.
  const Track* truth_track = nullptr;
  const Track* simulated_track = nullptr;
};

// A finding as it is read.
struct FindingCard {
  std::string title, sentence, where, evidence;
  std::vector<std::pair<std::string, std::string>> parameters;    // name, value with error and unit
  std::vector<std::pair<std::string, std::string>> alternatives;  // which, and what would tell them apart
  bool can_be_switched = false;
  bool on = false;
};

// A bar of the proof.
struct ProofBar {
  std::string label;
  double position_rms_m = 0.0, heading_rms_rad = 0.0;  // the latter NaN where the truth has none
  enum class Kind { calibrated, with_findings, noise } kind = Kind::calibrated;
};

struct MysteryView {
  std::uint64_t seed = 0;
  std::vector<std::pair<std::string, std::string>> guesses;  // what is guessed, in words
  std::optional<std::string> guess;
  bool revealed = false;
  std::string answer;  // once revealed
  bool guessed_right = false, tool_right = false, tool_asked = false;
};

// An effect that was asked for, in words: what was said of it, and on what grounds.
struct AskedRow {
  std::string effect, answer, grounds;
  bool named = false;
};

struct DiagnosisView {
  std::vector<DiagnosedRun> runs;
  std::string vehicle_name;  // empty: none was opened
  bool can_diagnose = false;
  std::string why_not;
  std::string problem;  // what went wrong last, one line

  const Diagnosis* diagnosis = nullptr;
  const std::vector<Response>* responses = nullptr;  // what the mismatch depends on; null without an answer
  int answers = 0;                                   // so many were given so far
  std::size_t worst_run = 0;                         // of the answer, in the list
  bool stale = false;                                // the runs or the vehicle have changed since
  std::string verdict;
  std::vector<FindingCard> findings;
  // Error of the simulation over a metre: calibrated alone, and with what is switched on.
  std::optional<FitFigures> simulated_before, simulated_now;
  std::vector<ProofBar> proof;
  std::string proof_title;
  std::string over_which_way = "over each metre or radian";  // errors are gathered
  std::vector<std::pair<std::string, std::string>> not_testable;  // what, and why with the drive that would show it
  std::vector<AskedRow> asked;                                    // the likeliest first
  std::string next_drive;                                         // in words
  std::vector<Vec2> advised_way;                                  // of the next drive
  bool can_simulate_advice = false;
  std::string why_no_advice;

  std::optional<MysteryView> mystery;
  bool busy = false;
  std::string job;
  double share_done = 0.0;

  bool findings_on() const {  // any of them, in the simulation
    for (const FindingCard& f : findings)
      if (f.on) return true;
    return false;
  }
};

// The colour that a run has in the list and on the floor.
ImU32 run_colour(std::size_t run, const Theme& theme);

// What the panels remember.
struct DiagnosisState {
  std::size_t run = 0;  // shown
  int answers_seen = 0;
  std::size_t runs_seen = 0;
  std::vector<Stretch> brush;      // of that run
  std::optional<std::size_t> lit;  // the finding whose places were asked for
  int response = 0;
  int seed = 1;
  int guess = -1;
  bool fit_floor = false;   // another run was chosen
  bool show_advice = true;  // on the floor
  PlotView time_view, response_view;
  std::string export_folder;  // without a slash at its end; empty: where the program was started
};

}  // namespace odolab::ui
