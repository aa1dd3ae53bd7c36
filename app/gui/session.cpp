#include "app/gui/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/gui/first_scenario.h"
#include "core/diagnosis/given_recordings.h"
#include "core/io/file_kind.h"
#include "core/io/import/imported_recording.h"
#include "core/io/recording_csv.h"
#include "core/io/scenario_toml.h"
#include "core/io/vehicle_toml.h"
#include "core/recording/vehicle_samples.h"
#include "core/scenario/suited_scenario.h"

namespace odolab {

namespace {

constexpr double kAtOnce_s = 1e9;
constexpr double kFastest = 1e6;  // "as fast as possible" is bounded by the time of a picture alone

}  // namespace

Session::Session(bool threaded, const std::string& guide_folder, const std::string& edited)
    : guide_(guide_folder), edited_(edited), jobs_(threaded) {
  load(first_scenario(), nullptr, "");
}

void Session::take_up_edits() {
  if (!edited_.is_there()) return;
  const Result<Scenario> scenario = read_scenario(edited_.path());
  if (!scenario) return say(scenario.error().message(), true);
  load(*scenario, nullptr, "");
  say_for_a_while("This is the scenario as you left it. Another one is opened by File.");
}

void Session::advance(double wall_s, const std::function<bool()>& go_on) {
  jobs_.poll();
  guide_.advance(wall_s);
  diagnosis_.advance(wall_s);
  done_or_said(edited_.advance(wall_s, run_->scenario()));
  for (ui::Message& m : messages_) m.left_s -= wall_s;
  messages_.erase(
      std::remove_if(messages_.begin(), messages_.end(), [](const ui::Message& m) { return m.left_s <= 0.0; }),
      messages_.end());
  if (!playing_ || wall_s <= 0.0) {
    reached_speed_ = 0.0;
    return;
  }
  const double wanted_s = wall_s * (speed_ == 0.0 ? kFastest : speed_);
  double before_s = 0.0, after_s = 0.0;
  if (mode_ == ui::Mode::compare) {
    before_s = comparison_.time_s;
    const double fastest = comparison_.duration_s() / 4.0 * wall_s;  // the whole in four seconds
    comparison_.time_s = std::min(comparison_.duration_s(), before_s + (speed_ == 0.0 ? fastest : wanted_s));
    after_s = comparison_.time_s;
    if (after_s >= comparison_.duration_s()) playing_ = false;
  } else {
    before_s = run_->shown_s();
    run_->advance(wanted_s, go_on);
    after_s = run_->shown_s();
    if (run_->at_end()) playing_ = false;
  }
  const double now = (after_s - before_s) / wall_s;
  reached_speed_ = reached_speed_ == 0.0 ? now : reached_speed_ + std::min(1.0, wall_s / 0.4) * (now - reached_speed_);
}

void Session::say(const std::string& text, bool is_error) {
  forget(text);  // said again, it is the newest
  messages_.push_back({text, is_error});
}

void Session::say_for_a_while(const std::string& text) {
  constexpr double kWhile = 10.0;
  say(text, false);
  messages_.back().left_s = kWhile;
}

void Session::forget(const std::string& text) {
  messages_.erase(
      std::remove_if(messages_.begin(), messages_.end(), [&](const ui::Message& m) { return m.text == text; }),
      messages_.end());
}

bool Session::can_undo() const {
  if (mode_ == ui::Mode::diagnose) return diagnosis_.can_undo();
  if (guide_in_hand()) return guide_.can_undo() && !jobs_.running();
  return edits_scenario() && !undo_.empty();
}

bool Session::can_redo() const {
  if (mode_ == ui::Mode::diagnose) return diagnosis_.can_redo();
  if (guide_in_hand()) return guide_.can_redo() && !jobs_.running();
  return edits_scenario() && !redo_.empty();
}

std::string Session::title() const {
  const std::string& name = run_->scenario().name;
  return title_file_.empty() || name != titled_ ? name : name + " – " + title_file_;
}

bool Session::take_picture_wish() {
  const bool wished = picture_wished_;
  picture_wished_ = false;
  return wished;
}

bool Session::refused(const Error& error) {
  if (mode_ == ui::Mode::diagnose)
    diagnosis_.complain(error.message());
  else
    say(error.message(), true);
  return false;
}

bool Session::done_or_said(const Result<Done>& done) {
  if (!done) say(done.error().message(), true);
  return done.ok();
}

bool Session::open_lesson(const std::string& path) {
  if (refuse_while_busy("the lesson")) return false;
  const bool was_open = lesson_.is_open();
  if (!was_open) done_or_said(edited_.advance(kAtOnce_s, run_->scenario()));
  if (!done_or_said(lesson_.open(path))) return false;
  if (!was_open && !replayed_) before_lesson_ = run_->scenario();
  mode_ = ui::Mode::learn;
  begin_lesson_step();
  return true;
}

void Session::begin_lesson_step() {
  const Scenario* scenario = lesson_.scenario();
  if (!scenario) return;  // the floor stays as the last step left it
  load(*scenario, nullptr, "");
  speed_ = lesson_.step().mystery ? 10.0 : lesson_.step().speed;
  playing_ = !scenario->benchmark;
}

bool Session::refuse_while_busy(const std::string& what) {
  if (!jobs_.running()) return false;
  say("Busy " + jobs_.name() + ": cancel it, or start " + what + " when it is done.", true);
  return true;
}

void Session::load(const Scenario& scenario, std::shared_ptr<const Recording> replayed, const std::string& path) {
  replayed_ = std::move(replayed);
  run_ = std::make_unique<DriveRun>(scenario, replayed_);
  scenario_path_ = path;
  titled_ = scenario.name;
  title_file_ = path.substr(path.find_last_of('/') + 1);
  undo_.clear();
  redo_.clear();
  if (!jobs_.running()) bench_.clear();
  ++loads_;
}

void Session::change(const Scenario& scenario) {
  const bool replays = std::holds_alternative<ReplayPath>(scenario.path);
  run_ = std::make_unique<DriveRun>(scenario, replays ? replayed_ : nullptr);
}

// What a lesson shows is not the student's own.
void Session::was_edited() {
  if (!lesson_.is_open()) edited_.changed();
}

bool Session::open(const std::string& path) {
  bool opened = false;
  if (mode_ == ui::Mode::diagnose) diagnosis_.begin_opening();
  switch (file_kind(path)) {
    case FileKind::scenario:
      opened = open_scenario(path);
      break;
    case FileKind::vehicle:
      opened = guide_in_hand() ? done_or_said(guide_.choose_vehicle(path, jobs_)) : open_vehicle(path);
      break;
    case FileKind::lesson:
      opened = open_lesson(path);
      break;
    case FileKind::guide:
      opened = !refuse_while_busy("the session") && done_or_said(guide_.resume(path, jobs_));
      if (opened) mode_ = ui::Mode::calibrate;
      break;
    default:
      opened = open_recording(path);  // says itself what it is missing in a file of no known kind
  }
  if (opened) opened_files_.push_back(path);
  return opened;
}

bool Session::open_scenario(const std::string& path) {
  const Result<Scenario> scenario = read_scenario(path);
  if (!scenario) {
    say(scenario.error().message(), true);
    return false;
  }
  if (const ReplayPath* replays = std::get_if<ReplayPath>(&scenario->path)) {
    Result<ImportedRecording> imported = load_recording(beside(path, replays->recording));
    if (!imported) {
      say(imported.error().message(), true);
      return false;
    }
    edited_.forget();
    const auto recording = std::make_shared<const Recording>(std::move(imported->recording));
    load(*scenario, recording, path);
    compare(recording, *scenario);
    return true;
  }
  edited_.forget();
  load(*scenario, nullptr, path);
  mode_ = scenario->benchmark ? ui::Mode::calibrate : ui::Mode::drive;
  playing_ = !scenario->benchmark;
  return true;
}

bool Session::open_vehicle(const std::string& path) {
  const Result<Vehicle> vehicle = read_vehicle(path);
  if (!vehicle) return refused(vehicle.error());
  if (mode_ == ui::Mode::diagnose) {
    diagnosis_.set_vehicle(*vehicle);
    return true;
  }
  opened_vehicle_ = *vehicle;
  const Scenario scenario = with_vehicle(run_->scenario(), *vehicle);
  execute(ui::EditScenario{scenario});
  if (comparison_.loaded() && !jobs_.running()) {
    const auto recording = comparison_.as_given();
    compare(recording, replay_scenario(*vehicle, *recording));
  }
  return true;
}

bool Session::open_recording(const std::string& path) {
  if (refuse_while_busy("the recording")) return false;
  Result<ImportedRecording> imported = load_recording(path);
  if (!imported) return refused(imported.error());
  if (mode_ == ui::Mode::diagnose) {
    const Result<Done> added = diagnosis_.add(path, std::move(*imported));
    return added || refused(added.error());
  }
  for (const std::string& warning : imported->warnings) say(imported->recording.name + ": " + warning, false);
  if (guide_in_hand()) return done_or_said(guide_.take(path, imported->recording, jobs_));
  const Recording& read = imported->recording;
  // With the vehicle that was opened, or else with the one that drives, if only that has such encoders.
  const Vehicle& driving = run_->scenario().vehicle;
  const bool fits =
      opened_vehicle_ && (missing_columns(read, *opened_vehicle_).empty() || !missing_columns(read, driving).empty());
  const Vehicle& vehicle = fits ? *opened_vehicle_ : driving;
  if (!opened_vehicle_)
    say_for_a_while("Taken for a recording of " + vehicle.name +
                    ", the vehicle in Drive; open its own file if it is of another.");
  if (const std::optional<Error> unknown = ticks_of_unknown_size(read, vehicle, path)) return refused(*unknown);
  const auto recording = std::make_shared<const Recording>(std::move(imported->recording));
  compare(recording, replay_scenario(vehicle, *recording));
  return true;
}

void Session::compare(std::shared_ptr<const Recording> recording, const Scenario& scenario) {
  mode_ = ui::Mode::compare;
  playing_ = false;
  ++loads_;
  comparison_.open(std::move(recording), scenario, jobs_, [this](const std::string& words) { say(words, true); });
  for (const std::string& fault : comparison_.faults()) say(fault, false);
}

}  // namespace odolab
