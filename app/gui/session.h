// Everything that is open: the scenario and its run, the bench, the recording. It carries out what panels ask for,
// through the same doors as the command line.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/comparison.h"
#include "app/gui/diagnosis_desk.h"
#include "app/gui/drive_run.h"
#include "app/gui/edited_scenario.h"
#include "app/gui/guide_desk.h"
#include "app/gui/jobs.h"
#include "app/gui/lesson_desk.h"
#include "app/gui/umbmark_bench.h"
#include "ui/actions.h"
#include "ui/panels/message_bar.h"

namespace odolab {

class Session {
 public:
  // Without threads every job is done when its action has been carried out.
  // `guide_folder` keeps the sessions of guides, `edited` the scenario as it is edited; empty: they are kept nowhere.
  explicit Session(bool threaded, const std::string& guide_folder = "", const std::string& edited = "");

  void execute(const ui::Action& action);
  // Plays on after `wall_s` seconds in front of the window; `go_on` says whether there is time left for this picture.
  void advance(double wall_s, const std::function<bool()>& go_on);

  // Opens a scenario, a vehicle or a recording. False, with a message, where that fails.
  bool open(const std::string& path);
  void say(const std::string& text, bool is_error);
  void say_for_a_while(const std::string& text);
  // Opens the scenario that was edited when the window closed last, if it did so without saving it.
  void take_up_edits();

  ui::Mode mode() const { return mode_; }
  bool playing() const { return playing_; }
  double speed() const { return speed_; }
  double reached_speed() const { return reached_speed_; }
  const DriveRun& run() const { return *run_; }
  const UmbmarkBench& bench() const { return bench_; }
  const Comparison& comparison() const { return comparison_; }
  const GuideDesk& guide() const { return guide_; }
  // A guide is on the screen: what is dropped belongs to it.
  bool guide_in_hand() const { return mode_ == ui::Mode::calibrate && guide_.shown() && guide_.is_open(); }
  const LessonDesk& lesson() const { return lesson_; }
  const DiagnosisDesk& diagnosis() const { return diagnosis_; }
  const Jobs& jobs() const { return jobs_; }
  const std::vector<ui::Message>& messages() const { return messages_; }
  // The scenario's name, and the file that it came from.
  std::string title() const;
  // Of what is on the screen: what was entered into a guide, the runs of a diagnosis, the scenario. A comparison has
  // nothing to edit.
  bool can_undo() const;
  bool can_redo() const;
  bool wants_to_quit() const { return wants_to_quit_; }
  // True once after a person has asked for a picture.
  bool take_picture_wish();
  // Grows whenever another scenario or recording is loaded, so that views can fit themselves.
  int loads() const { return loads_; }
  // The files opened so far, each time one was, the newest last.
  const std::vector<std::string>& opened_files() const { return opened_files_; }

 private:
  struct Executor;
  // A scenario to come back to; where only the floor was changed, the run goes on.
  struct Step {
    Scenario scenario;
    bool floor_only = false;
  };

  void load(const Scenario& scenario, std::shared_ptr<const Recording> replayed, const std::string& path);
  void change(const Scenario& scenario);
  void was_edited();
  void forget(const std::string& text);
  bool open_scenario(const std::string& path);
  bool open_vehicle(const std::string& path);
  bool open_recording(const std::string& path);
  void compare(std::shared_ptr<const Recording> recording, const Scenario& scenario);
  bool refuse_while_busy(const std::string& what);
  // The scenario is what this mode shows and changes.
  bool edits_scenario() const {
    return mode_ == ui::Mode::drive || mode_ == ui::Mode::learn || (mode_ == ui::Mode::calibrate && !guide_.shown());
  }
  bool done_or_said(const Result<Done>& done);
  bool refused(const Error& error);  // said where it arose; false
  bool open_lesson(const std::string& path);
  void begin_lesson_step();

  ui::Mode mode_ = ui::Mode::drive;
  bool playing_ = false;
  double speed_ = 1.0;
  double reached_speed_ = 0.0;
  std::unique_ptr<DriveRun> run_;
  Path path_before_hand_ = SquarePath{};
  std::string scenario_path_;  // empty: not from a file
  std::shared_ptr<const Recording> replayed_;
  UmbmarkBench bench_;
  Comparison comparison_;
  GuideDesk guide_;
  EditedScenario edited_;
  LessonDesk lesson_;
  DiagnosisDesk diagnosis_;
  std::optional<Scenario> before_lesson_;  // to come back to
  std::optional<Vehicle> opened_vehicle_;
  std::vector<ui::Message> messages_;
  std::string titled_, title_file_;  // the scenario that came from a file, by its name
  std::vector<Step> undo_, redo_;
  std::vector<std::string> opened_files_;
  bool picture_wished_ = false;
  bool wants_to_quit_ = false;
  int loads_ = 0;
  Jobs jobs_;  // last: its thread ends before what it works on
};

}  // namespace odolab
