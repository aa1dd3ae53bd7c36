// The runs that are to be diagnosed, the answer, and the simulation with what was found switched on.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/jobs.h"
#include "app/gui/unit_mismatch.h"
#include "core/diagnosis/diagnosis.h"
#include "core/io/import/imported_recording.h"
#include "physics/experiments/drawn_mystery.h"
#include "ui/diagnosis.h"

namespace odolab {

// Recordings driven in the simulator with one model: their tracks at the times of the truth.
struct SimulatedRuns {
  std::vector<Track> tracks;
  std::optional<FitFigures> error;
};

class DiagnosisDesk {
 public:
  // A recording of the list.
  struct Run {
    std::shared_ptr<const Recording> recording;
    std::string path;  // empty: it came from no file
    std::string name;  // no other run has it
    bool held_out = false;
    bool simulated = false;
    std::string truth_words;
    std::string problem;  // why it cannot be judged
    std::vector<std::string> faults;
    std::vector<std::string> notes;  // on how it came about
    std::shared_ptr<const ui::Trail> way;
    std::shared_ptr<const Track> truth;
  };

  void set_vehicle(const Vehicle& vehicle);
  // An error where this file is in the list. What the list has from another file, as with the second of a pair, is
  // left.
  Result<Done> add(const std::string& path, ImportedRecording imported);
  void carry_out(const ui::DiagnosisAction& action, Jobs& jobs);
  // Says it in the panel until something else is done.
  void complain(const std::string& words) { problem_ = words; }
  // Files that are dropped together are opened between two pictures, and what is wrong with one of them stays to be
  // read.
  void begin_opening() {
    if (!opening_) problem_.clear();
    opening_ = true;
  }
  // Moves the simulated tracks on towards where they belong.
  void advance(double wall_s);

  void undo();
  void redo();
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  const std::vector<Run>& runs() const { return given_.runs; }
  const std::optional<Vehicle>& vehicle() const { return given_.vehicle; }
  const Diagnosis* diagnosis() const { return answer_ ? &answer_->diagnosis : nullptr; }
  const std::vector<bool>& switched_on() const { return on_; }
  const std::string& problem() const { return problem_; }
  bool moving() const { return share_ < 1.0; }
  ui::DiagnosisView view(const Jobs& jobs) const;
  // The report, the fitted model, the diagnosis as JSON, or what is shown as CSV: through the doors of the command
  // line.
  Result<Done> write(const ui::ExportDiagnosis& what) const;

 private:
  struct Given {
    std::optional<Vehicle> vehicle;
    std::vector<Run> runs;
    std::shared_ptr<const DrawnMystery> mystery;
    std::optional<std::string> guess;
    bool revealed = false;
  };
  struct Answer {
    Diagnosis diagnosis;
    Vehicle nominal;
    std::vector<Run> runs;  // those fitted on, then those held out
    std::size_t fitted_on = 0;
    std::vector<std::vector<UnitMismatch>> units;  // of each run
    std::vector<std::vector<LocatedStretch>> located;
    std::vector<Track> truth;  // of each run; of a single drive where its axle was
    std::vector<Response> responses;
    std::vector<Recording> fitted() const;
  };
  using Choice = std::vector<bool>;

  void append(const std::string& path, ImportedRecording imported);
  void remember();
  void changed();
  void judge_runs();
  void rename_runs();
  void find_missing(Jobs& jobs);
  void switch_finding(std::size_t finding, bool on, Jobs& jobs);
  void simulate(const Choice& choice, Jobs& jobs);
  void move_to(const Choice& choice);
  void draw_mystery(std::uint64_t seed, Jobs& jobs);
  void simulate_advice(Jobs& jobs);
  Pose advice_start() const;
  // Of the unit that is shown; null where nothing of the run can be drawn.
  const UnitMismatch* unit_of(std::size_t answered) const;
  // Which of the answer's runs this one is; none where it was not part of it.
  std::optional<std::size_t> answered(const Run& run) const;
  static SimulatedRuns simulated(const Answer& answer, const Choice& choice, const Progress& progress,
                                 std::string& problem);

  Given given_;
  std::vector<Given> undo_, redo_;
  int revision_ = 0, answered_revision_ = 0;
  std::shared_ptr<const Answer> answer_;
  std::map<Choice, SimulatedRuns> simulations_;  // of the answer
  Choice on_;
  std::vector<Track> from_, shown_;
  double share_ = 1.0;  // of the way from `from_` to where the switches say
  std::string unit_;    // shown of the answer's runs; of those that lack it the first
  std::vector<Vec2> advised_way_;
  int answers_ = 0;
  std::string problem_;
  bool opening_ = false;
};

}  // namespace odolab
