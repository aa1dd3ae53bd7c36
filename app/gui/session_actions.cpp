// What each action of a person does to the session.
#include <algorithm>
#include <filesystem>

#include "app/gui/first_scenario.h"
#include "app/gui/session.h"
#include "core/io/recording_csv.h"
#include "core/io/scenario_toml.h"

namespace odolab {

namespace {

constexpr std::size_t kMostUndo = 100;
constexpr double kPatience = 3.0;  // times the planned duration: a robot that has lost its way drives on for good

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
    s.was_edited();
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
    s.was_edited();
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
    else if (s.guide_in_hand() && s.can_undo())
      s.guide_.undo(s.jobs_);
    else if (s.can_undo())
      swap_scenario(s.undo_, s.redo_);
  }
  void operator()(const ui::Redo&) const {
    if (s.mode_ == ui::Mode::diagnose)
      s.diagnosis_.redo();
    else if (s.guide_in_hand() && s.can_redo())
      s.guide_.redo(s.jobs_);
    else if (s.can_redo())
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
    s.was_edited();
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
  void operator()(const ui::BeginGuide& a) const {
    if (!s.refuse_while_busy("the session")) s.guide_.begin(a.kind, a.real_robot, s.run_->scenario());
  }
  void operator()(const ui::ResumeGuide& a) const {
    if (!s.refuse_while_busy("the session")) s.done_or_said(s.guide_.resume(a.path, s.jobs_));
  }
  void operator()(const ui::LeaveGuide&) const {
    if (!s.refuse_while_busy("something else")) s.guide_.leave();
  }
  void operator()(const ui::ChangeGuide& a) const { s.guide_.change(a, s.jobs_); }
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
    if (!s.done_or_said(write_scenario(a.path, scenario))) return;
    s.edited_.forget();
    s.say("Scenario saved as " + a.path, false);
  }
  void operator()(const ui::SaveRecording& a) const {
    if (comparing() && s.comparison_.loaded()) {
      if (s.done_or_said(write_recording_csv(a.path, *s.comparison_.as_given())))
        s.say("Recording saved as " + a.path, false);
      return;
    }
    const Result<Recording> recording = s.run_->recording();
    if (!recording)
      s.say(recording.error().message(), true);
    else if (s.done_or_said(write_recording_csv(a.path, *recording)))
      s.say("Recording saved as " + a.path, false);
  }
  void operator()(const ui::SaveCurves& a) const {
    if (s.done_or_said(write_recording_csv(a.path, a.curves))) s.say("Curves saved as " + a.path, false);
  }
  void operator()(const ui::LoadFirstScenario&) const {
    s.edited_.forget();
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

void Session::execute(const ui::Action& action) {
  if (mode_ == ui::Mode::diagnose && plays(action)) return;  // nothing plays there
  std::visit(Executor{*this}, action);
  jobs_.poll();
}

}  // namespace odolab
