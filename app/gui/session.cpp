#include "app/gui/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/gui/first_scenario.h"
#include "core/io/file_kind.h"
#include "core/io/import/imported_recording.h"
#include "core/io/recording_csv.h"
#include "core/io/scenario_toml.h"
#include "core/io/vehicle_toml.h"
#include "core/recording/vehicle_samples.h"
#include "core/scenario/suited_scenario.h"

namespace odolab {

namespace {

constexpr std::size_t kMostUndo = 100;
constexpr double kPatience = 3.0;  // times the planned duration: a robot that has lost its way drives on for good
constexpr double kFastest = 1e6;   // "as fast as possible" is bounded by the time of a picture alone

constexpr const char* kCableDeleted = "Cable deleted, Ctrl+Z brings it back";
constexpr const char* kPatchDeleted = "Patch deleted, Ctrl+Z brings it back";

// The path, or one with a number before its ending: no file of before is written over.
std::string not_there_yet(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path wanted(path);
  fs::path free = wanted;
  for (int k = 2; fs::exists(free, none); ++k)
    free = wanted.parent_path() / (wanted.stem().string() + "-" + std::to_string(k) + wanted.extension().string());
  return free.string();
}

bool plays(const ui::Action& action) {
  return std::holds_alternative<ui::Play>(action) || std::holds_alternative<ui::StepForward>(action) ||
         std::holds_alternative<ui::StepBack>(action) || std::holds_alternative<ui::ToStart>(action) ||
         std::holds_alternative<ui::ToEnd>(action) || std::holds_alternative<ui::Restart>(action);
}

}  // namespace

// Carries out one action each.
struct Session::Executor {
  Session& s;

  bool comparing() const { return s.mode_ == ui::Mode::compare; }

  void operator()(const ui::Play&) const {
    if (comparing()) {
      if (!s.comparison_.shown()) return;
      if (s.comparison_.time_s >= s.comparison_.duration_s()) s.comparison_.time_s = 0.0;
    } else if (s.run_->at_end()) {
      return;
    }
    s.playing_ = true;
  }
  void operator()(const ui::Pause&) const { s.playing_ = false; }
  void operator()(const ui::StepForward&) const {
    s.playing_ = false;
    if (comparing())
      s.comparison_.time_s = std::min(s.comparison_.duration_s(), s.comparison_.time_s + 0.02);
    else
      s.run_->step_forward();
  }
  void operator()(const ui::StepBack&) const {
    s.playing_ = false;
    if (comparing())
      s.comparison_.time_s = std::max(0.0, s.comparison_.time_s - 0.02);
    else
      s.run_->step_back();
  }
  void operator()(const ui::ToStart&) const {
    if (comparing())
      s.comparison_.time_s = 0.0;
    else
      s.run_->show(0.0);
  }
  void operator()(const ui::ToEnd&) const {
    if (comparing())
      s.comparison_.time_s = s.comparison_.duration_s();
    else
      s.run_->show(s.run_->latest_s());
  }
  void operator()(const ui::Restart&) const {
    if (comparing())
      s.comparison_.time_s = 0.0;
    else
      s.run_->restart();
    s.playing_ = !comparing() || s.comparison_.shown() != nullptr;
  }
  void operator()(const ui::SetSpeed& a) const { s.speed_ = a.factor; }
  void operator()(const ui::ScrubTo& a) const {
    s.playing_ = false;
    if (comparing())
      s.comparison_.time_s = std::clamp(a.time_s, 0.0, s.comparison_.duration_s());
    else
      s.run_->show(a.time_s);
  }
  void operator()(const ui::EditScenario& a) const {
    const std::vector<std::string> problems = problems_in(a.scenario);
    if (!problems.empty()) {
      s.say(problems.front(), true);
      return;
    }
    remember_for_undo(false);
    s.change(a.scenario);
  }
  void operator()(const ui::SetFloor& a) const {
    const std::vector<std::string> problems = problems_in(a.floor);
    if (!problems.empty()) {
      s.say(problems.front(), true);
      return;
    }
    if (a.begins_gesture) remember_for_undo(true);
    const Floor& before = s.run_->scenario().floor;
    const bool fewer_cables = a.floor.bumps.size() < before.bumps.size();
    const bool fewer_patches = a.floor.slip_zones.size() < before.slip_zones.size();
    s.run_->set_floor(a.floor);
    if (fewer_cables) s.say_for_a_while(kCableDeleted);
    if (fewer_patches) s.say_for_a_while(kPatchDeleted);
  }
  void operator()(const ui::DriveByHandInstead& a) const {
    Scenario scenario = s.run_->scenario();
    if (a.by_hand == std::holds_alternative<HandPath>(scenario.path)) return;
    if (a.by_hand) {
      s.path_before_hand_ = scenario.path;
      scenario.path = HandPath{600.0};
      scenario.benchmark.reset();
    } else {
      scenario.path = s.path_before_hand_;
    }
    (*this)(ui::EditScenario{scenario});
    s.playing_ = true;
  }
  void operator()(const ui::DriveByHand& a) const {
    if (std::holds_alternative<HandPath>(s.run_->scenario().path))
      s.run_->drive_by_hand(a.speed_mps, a.yaw_rate_radps, a.sideways_mps);
  }
  void operator()(const ui::Push& a) const { s.run_->push(a.impulse_ns); }
  void operator()(const ui::Undo&) const {
    if (s.mode_ == ui::Mode::diagnose)
      s.diagnosis_.undo();
    else
      swap_scenario(s.undo_, s.redo_);
  }
  void operator()(const ui::Redo&) const {
    if (s.mode_ == ui::Mode::diagnose)
      s.diagnosis_.redo();
    else
      swap_scenario(s.redo_, s.undo_);
  }
  void remember_for_undo(bool floor_only) const {
    s.undo_.push_back({s.run_->scenario(), floor_only});
    if (s.undo_.size() > kMostUndo) s.undo_.erase(s.undo_.begin());
    s.redo_.clear();
  }
  void swap_scenario(std::vector<Step>& from, std::vector<Step>& to) const {
    if (from.empty()) return;
    s.forget(kCableDeleted);
    s.forget(kPatchDeleted);
    const Step step = from.back();
    from.pop_back();
    to.push_back({s.run_->scenario(), step.floor_only});
    if (step.floor_only)
      s.run_->set_floor(step.scenario.floor);
    else
      s.change(step.scenario);
  }
  void operator()(const ui::StartBenchmark& a) const {
    const std::optional<Benchmark>& asked = s.run_->scenario().benchmark;
    const int runs = a.runs_each_way > 0 ? a.runs_each_way : asked ? asked->runs_each_way : 5;
    if (!s.refuse_while_busy("UMBmark")) s.bench_.start(s.run_->scenario(), runs, a.keep_things, s.jobs_);
  }
  void operator()(const ui::ApplyCalibration&) const {
    if (!s.refuse_while_busy("the calibrated squares")) s.bench_.apply(s.jobs_);
  }
  void operator()(const ui::AdoptCalibration&) const {
    const DifferentialDrive* vehicle = s.bench_.kept_vehicle();
    if (!vehicle) return;
    Scenario scenario = s.run_->scenario();
    scenario.vehicle.kind = *vehicle;
    scenario.vehicle_file.clear();
    (*this)(ui::EditScenario{scenario});
    s.mode_ = ui::Mode::drive;
    s.playing_ = true;
  }
  void operator()(const ui::ClearBenchmark&) const {
    if (!s.bench_.running()) s.bench_.clear();
  }
  void operator()(const ui::CancelJob&) const { s.jobs_.cancel(); }
  void operator()(const ui::ShowGuides& a) const { s.guide_.show(a.on); }
  void operator()(const ui::BeginGuide& a) const { s.guide_.begin(a.kind, a.real_robot, s.run_->scenario()); }
  void operator()(const ui::ResumeGuide& a) const { s.done_or_said(s.guide_.resume(a.path, s.jobs_)); }
  void operator()(const ui::LeaveGuide&) const {
    if (!s.refuse_while_busy("something else")) s.guide_.leave();
  }
  void operator()(const ui::ChangeGuide& a) const { s.guide_.change(a.session, s.jobs_); }
  void operator()(const ui::ChooseGuideVehicle& a) const { s.done_or_said(s.guide_.choose_vehicle(a.path, s.jobs_)); }
  void operator()(const ui::DriveGuide&) const {
    if (!s.refuse_while_busy("the guide's drive")) s.guide_.drive(s.jobs_);
  }
  void operator()(const ui::ExportGuide& a) const {
    const std::string path = not_there_yet(a.path);
    if (s.done_or_said(s.guide_.write(a.what, path))) s.say("Written: " + path, false);
  }
  void operator()(const ui::OpenLesson& a) const { s.open_lesson(a.path); }
  void operator()(const ui::LessonStepTo& a) const {
    if (s.refuse_while_busy("another step")) return;
    s.lesson_.step_to(a.step);
    s.begin_lesson_step();
  }
  void operator()(const ui::AnswerLesson& a) const { s.lesson_.answer(a.choice, a.stake); }
  void operator()(const ui::AskMystery&) const {
    if (!s.refuse_while_busy("the diagnosis")) s.lesson_.ask(s.jobs_);
  }
  void operator()(const ui::LeaveLesson&) const {
    if (s.refuse_while_busy("something else")) return;
    s.lesson_.leave();
    s.playing_ = false;
    if (s.before_lesson_) s.load(*s.before_lesson_, nullptr, "");
    s.before_lesson_.reset();
  }
  void operator()(const ui::ReplayWith& a) const { s.comparison_.choose(a.vehicle); }
  void operator()(const ui::CalibrateFromRecording&) const {
    if (!s.refuse_while_busy("the calibration"))
      s.comparison_.calibrate(s.jobs_,
                              [this_session = &s](const std::string& words) { this_session->say(words, true); });
  }
  void operator()(const ui::RecordSimulatedRun&) const {
    if (s.refuse_while_busy("a simulated run")) return;
    const Scenario scenario = s.run_->scenario();
    const std::shared_ptr<const Recording> replayed = s.replayed_;
    Session* session = &s;
    const auto made = std::make_shared<Recording>();
    const auto arrived = std::make_shared<bool>(false);
    s.jobs_.start(
        "driving the scenario to its end",
        [scenario, replayed, made, arrived](const Progress& progress, const Jobs::Deliver&) {
          Simulation simulation(scenario, scenario.seed, replayed);
          const double begin_s = simulation.state().time_s,
                       expected_s = std::max(1.0, simulation.expected_duration_s());
          for (long k = 0; !simulation.state().finished && simulation.state().time_s - begin_s < kPatience * expected_s;
               ++k) {
            simulation.step();
            if (k % 1000 == 0 && !goes_on(progress, (simulation.state().time_s - begin_s) / expected_s)) return;
          }
          *arrived = simulation.state().finished;
          *made = simulation.recording();
          made->name = scenario.name + ", simulated";
        },
        [session, scenario, made, arrived](bool cancelled) {
          if (cancelled) return;
          if (!*arrived)
            session->say("The simulated run never arrived: the robot cannot follow this path on this floor.", true);
          else
            session->compare(made, replay_scenario(scenario.vehicle, *made));
        });
  }
  void operator()(const ui::InDiagnosis& a) const {
    const auto* wanted = std::get_if<ui::ExportDiagnosis>(&a.what);
    if (!wanted) {
      s.diagnosis_.carry_out(a.what, s.jobs_);
      return;
    }
    ui::ExportDiagnosis out = *wanted;
    out.path = not_there_yet(out.path);
    if (s.done_or_said(s.diagnosis_.write(out))) s.say("Written: " + out.path, false);
  }
  void operator()(const ui::TakeDriveVehicle&) const { s.diagnosis_.set_vehicle(s.run_->scenario().vehicle); }
  void operator()(const ui::OpenFile& a) const { s.open(a.path); }
  void operator()(const ui::SaveScenario& a) const {
    Scenario scenario = s.run_->scenario();
    scenario.vehicle_file.clear();
    const Result<Done> done = write_scenario(a.path, scenario);
    if (done)
      s.say("Scenario saved as " + a.path, false);
    else
      s.say(done.error().message(), true);
  }
  void operator()(const ui::SaveRecording& a) const {
    const bool recorded = comparing() && s.comparison_.loaded();
    const Result<Done> done =
        write_recording_csv(a.path, recorded ? s.comparison_.recording() : s.run_->simulation().recording());
    if (done)
      s.say("Recording saved as " + a.path, false);
    else
      s.say(done.error().message(), true);
  }
  void operator()(const ui::LoadFirstScenario&) const {
    s.load(first_scenario(), nullptr, "");
    s.mode_ = ui::Mode::drive;
    s.playing_ = true;
  }
  void operator()(const ui::SetMode& a) const {
    if (a.mode == s.mode_) return;
    s.mode_ = a.mode;
    s.playing_ = false;
  }
  void operator()(const ui::DismissMessage& a) const {
    if (a.index < s.messages_.size()) s.messages_.erase(s.messages_.begin() + long(a.index));
  }
  void operator()(const ui::SavePicture&) const { s.picture_wished_ = true; }
  void operator()(const ui::Quit&) const { s.wants_to_quit_ = true; }
};

Session::Session(bool threaded, const std::string& guide_folder) : guide_(guide_folder), jobs_(threaded) {
  load(first_scenario(), nullptr, "");
}

void Session::execute(const ui::Action& action) {
  if (mode_ == ui::Mode::diagnose && plays(action)) return;  // nothing plays there
  std::visit(Executor{*this}, action);
  jobs_.poll();
}

void Session::advance(double wall_s, const std::function<bool()>& go_on) {
  jobs_.poll();
  guide_.advance(wall_s);
  diagnosis_.advance(wall_s);
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
      opened = done_or_said(guide_.resume(path, jobs_));
      if (opened) mode_ = ui::Mode::calibrate;
      break;
    default:
      opened = open_recording(path);  // says itself what it is missing in a file of no known kind
  }
  if (opened) {
    opened_files_.erase(std::remove(opened_files_.begin(), opened_files_.end(), path), opened_files_.end());
    opened_files_.push_back(path);
  }
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
    const auto recording = std::make_shared<const Recording>(std::move(imported->recording));
    load(*scenario, recording, path);
    compare(recording, *scenario);
    return true;
  }
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
    const auto recording = std::make_shared<const Recording>(comparison_.recording());
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
  const auto recording = std::make_shared<const Recording>(std::move(imported->recording));
  // With the vehicle that was opened, or else with the one that drives, if only that has such encoders.
  const Vehicle& driving = run_->scenario().vehicle;
  const bool fits = opened_vehicle_ && (missing_columns(*recording, *opened_vehicle_).empty() ||
                                        !missing_columns(*recording, driving).empty());
  compare(recording, replay_scenario(fits ? *opened_vehicle_ : driving, *recording));
  return true;
}

void Session::compare(std::shared_ptr<const Recording> recording, const Scenario& scenario) {
  mode_ = ui::Mode::compare;
  playing_ = false;
  ++loads_;
  comparison_.open(std::move(recording), scenario, jobs_, [this](const std::string& words) { say(words, true); });
}

}  // namespace odolab
