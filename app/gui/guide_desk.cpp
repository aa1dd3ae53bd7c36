#include "app/gui/guide_desk.h"

#include <algorithm>
#include <ctime>
#include <filesystem>

#include "core/calibration/internal.h"
#include "core/guide/misfit.h"
#include "core/guide/recorded_run.h"
#include "core/io/guide_report.h"
#include "core/io/guide_toml.h"
#include "core/io/import/imported_recording.h"
#include "core/io/ros2_yaml.h"
#include "core/io/scenario_toml.h"
#include "core/io/vehicle_toml.h"
#include "physics/experiments/castor_prototype.h"

namespace odolab {

namespace {

constexpr double kSaveAfter_s = 0.4;  // of changes: less than the second that may be lost
constexpr std::size_t kMostUndo = 100;

namespace fs = std::filesystem;

std::string new_file(const std::string& folder, const std::string& key) {
  char stamp[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", std::localtime(&now));
  std::string path = folder + "/" + key + "-" + stamp + ".toml";
  std::error_code none;
  for (int k = 2; fs::exists(path, none); ++k)
    path = folder + "/" + key + "-" + stamp + "-" + std::to_string(k) + ".toml";
  return path;
}

// Beside the session: the simulated robot with its true machine and its floor.
std::string scenario_file_of(const std::string& file) { return file + ".scenario"; }

Vehicle usual_vehicle(GuideKind kind) {
  Vehicle vehicle;
  if (kind == GuideKind::castors) {
    vehicle.name = "Three castors";
    vehicle.kind = assumed_castor_prototype();
  } else if (kind == GuideKind::linked) {
    vehicle.name = "CLAPPER";
    vehicle.kind = Clapper{};
  }
  return vehicle;
}

}  // namespace

PageTask GuideDesk::task() const {
  return guide_of(session_->kind).pages[static_cast<std::size_t>(session_->page)].task;
}

void GuideDesk::open(const GuideSession& session, const std::string& file) {
  session_ = session;
  file_ = file;
  problem_.clear();
  undo_.clear();
  redo_.clear();
  internal_.reset();
  recordings_.clear();
  held_out_.clear();
  actual_.reset();
  shown_ = true;
  vehicle_files_.clear();
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(std::string(ODOLAB_ASSETS) + "/vehicles", none))
    if (const Result<Vehicle> vehicle = read_vehicle(entry.path().string());
        vehicle && why_not(guide_of(session.kind), *vehicle).empty())
      vehicle_files_.push_back(entry.path().string());
  std::sort(vehicle_files_.begin(), vehicle_files_.end());
  reckon();
}

void GuideDesk::begin(GuideKind kind, bool real_robot, const Scenario& scenario) {
  save();
  GuideSession session;
  session.kind = kind;
  session.real_robot = real_robot;
  scenario_ = scenario;
  session.vehicle = scenario.vehicle;
  if (!why_not(guide_of(kind), session.vehicle).empty()) {
    session.vehicle = usual_vehicle(kind);
    scenario_ = Scenario{};
    scenario_.vehicle = session.vehicle;
  }
  if (kind == GuideKind::extended_umbmark) session.draft.has_heading = true;
  open(session, folder_.empty() ? "" : new_file(folder_, guide_of(kind).key));
  changed_ = true;
  save();
  if (!real_robot && !file_.empty() && std::holds_alternative<DifferentialDrive>(session.vehicle.kind)) {
    Scenario kept = scenario_;
    kept.vehicle_file.clear();
    if (const Result<Done> done = write_scenario(scenario_file_of(file_), kept); !done)
      problem_ = done.error().message();
  }
}

Result<Done> GuideDesk::resume(const std::string& path, Jobs& jobs) {
  const Result<GuideSession> read = read_guide_session(path);
  if (!read) return read.error();
  save();
  std::error_code none;
  scenario_ = Scenario{};
  scenario_.vehicle = read->vehicle;
  if (fs::exists(scenario_file_of(path), none))
    if (Result<Scenario> scenario = read_scenario(scenario_file_of(path))) scenario_ = std::move(*scenario);
  open(*read, path);
  changed_ = false;
  read_recordings(jobs);
  return Done{};
}

void GuideDesk::leave() {
  save();
  session_.reset();
  look_for_saved();
}

void GuideDesk::show(bool on) {
  shown_ = on;
  if (on && !session_) look_for_saved();
}

void GuideDesk::change(const ui::ChangeGuide& change, Jobs& jobs) {
  if (!session_) return;
  // To turn to a page is no step to take back, unless it begins a round there.
  const bool turns = change.how == ui::GuideEdit::page && change.session.rounds.size() == session_->rounds.size();
  if (!turns && change.how != ui::GuideEdit::goes_on) remember();
  replace(change.session, jobs);
}

void GuideDesk::remember() {
  undo_.push_back(*session_);
  if (undo_.size() > kMostUndo) undo_.erase(undo_.begin());
  redo_.clear();
}

void GuideDesk::step(std::vector<GuideSession>& from, std::vector<GuideSession>& to, Jobs& jobs) {
  if (!session_ || from.empty()) return;
  to.push_back(*session_);
  GuideSession session = std::move(from.back());
  from.pop_back();
  session.reached = std::max(session.reached, session_->reached);
  problem_.clear();
  const bool same_files = session_->recordings == session.recordings;
  replace(session, jobs);
  if (same_files && !recordings_.empty()) calibrate_inside(jobs);  // the vehicle may be another
}

void GuideDesk::replace(const GuideSession& session, Jobs& jobs) {
  const bool same_files = session_->recordings == session.recordings && session_->held_out == session.held_out;
  if (session_->page != session.page) problem_.clear();
  session_ = session;
  session_->page = std::clamp(session.page, 0, int(guide_of(session.kind).pages.size()) - 1);
  session_->reached = std::max(session_->reached, session_->page);
  if (!same_files) read_recordings(jobs);
  changed_ = true;
  reckon();
}

Result<Done> GuideDesk::choose_vehicle(const std::string& path, Jobs& jobs) {
  const Result<Vehicle> vehicle = read_vehicle(path);
  if (!vehicle) return vehicle.error();
  if (!session_) return Done{};
  const std::string why = why_not(guide_of(session_->kind), *vehicle);
  if (!why.empty()) return Error{path, why, "another vehicle"};
  remember();
  session_->vehicle = *vehicle;
  changed_ = true;
  calibrate_inside(jobs);
  return Done{};
}

void GuideDesk::reckon() {
  outcome_ = outcome_of(*session_, internal_.get(), held_out_);
  experiments_.clear();
  const auto add = [this](const GuideRound& round, const std::string& name) {
    ui::BenchExperiment e;
    e.name = name;
    e.vehicle = round.nominal;
    e.runs = umbmark_runs(round, session_->side_m);
    e.measure = measure_umbmark(e.runs);
    experiments_.push_back(e);
  };
  for (std::size_t k = 0; k < session_->rounds.size(); ++k)
    add(session_->rounds[k], k == 0 ? "as it was" : k == 1 ? "after calibration" : "after a second compensation");
  if (!session_->bumped.runs.empty()) add(session_->bumped, "with bumps");
}

void GuideDesk::read_recordings(Jobs& jobs) {
  const auto read = [this](const std::vector<std::string>& files, std::vector<Recording>& recordings) {
    recordings.clear();
    for (const std::string& file : files) {
      const Result<ImportedRecording> recording = load_recording(file);
      if (recording)
        recordings.push_back(recording->recording);
      else
        problem_ = recording.error().message();
    }
  };
  read(session_->recordings, recordings_);
  read(session_->held_out, held_out_);
  calibrate_inside(jobs);
}

void GuideDesk::calibrate_inside(Jobs& jobs) {
  internal_.reset();
  reckon();
  if (recordings_.empty()) return;
  const Vehicle nominal = session_->vehicle;
  const std::vector<Recording> recordings = recordings_;
  const auto found = std::make_shared<std::optional<Result<InternalCalibration>>>();
  jobs.start(
      "calibrating from the inside",
      [nominal, recordings, found](const Progress& progress, const Jobs::Deliver&) {
        *found = calibrate_internally(recordings, nominal, progress);
      },
      [this, found](bool cancelled) {
        if (cancelled || !session_ || !*found) return;
        if (**found)
          internal_ = std::make_shared<const InternalCalibration>(***found);
        else
          problem_ = (*found)->error().message();
        reckon();
      });
}

Result<Done> GuideDesk::take(const std::string& path, const Recording& recording, Jobs& jobs) {
  if (!session_) return Done{};
  const PageTask page = task();
  if (page == PageTask::recordings) {
    if (jobs.running()) return Error{path, "a calibration under way", "it to be done first"};
    for (const std::string& known : session_->recordings)
      if (known == path) return Error{path, "a recording that is here already", "each once"};
    const std::string missing = missing_columns(recording, session_->vehicle);
    if (!missing.empty()) return Error{path, "no " + missing, "these columns"};
    remember();
    session_->recordings.push_back(path);
    recordings_.push_back(recording);
    changed_ = true;
    calibrate_inside(jobs);
    return Done{};
  }
  if (page == PageTask::held_out) {
    if (!outcome_.calibrated) return Error{path, "no calibration yet", "one to be held against it"};
    const Result<HeldOutError> error = held_out_error(recording, session_->vehicle, *outcome_.calibrated);
    if (!error) return error.error();
    remember();
    session_->held_out.push_back(path);
    held_out_.push_back(recording);
    changed_ = true;
    reckon();
    return Done{};
  }
  const GuideRound* round = round_on(*session_, page);
  if (!round || page == PageTask::verdict)
    return Error{path, "a recording", "it on the page on which the runs are entered"};
  Vehicle nominal = session_->vehicle;
  nominal.kind = round->runs.empty() && page != PageTask::again ? first_nominal(*session_) : round->nominal;
  const Result<GuideRun> run = run_in(recording, nominal);
  if (!run) return run.error();
  remember();
  enter_run(*session_, page, *run);
  changed_ = true;
  reckon();
  return Done{};
}

Result<Done> GuideDesk::write(ui::GuideExport what, const std::string& path) const {
  if (!session_) return Done{};
  if (what == ui::GuideExport::report) return write_report(path, guide_report(*session_, outcome_));
  if (!outcome_.calibrated) return Error{path, "no calibration yet", "one to write"};
  if (what == ui::GuideExport::vehicle) return write_vehicle(path, *outcome_.calibrated);
  const auto* before = std::get_if<DifferentialDrive>(&session_->vehicle.kind);
  const auto* after = std::get_if<DifferentialDrive>(&outcome_.calibrated->kind);
  if (!before || !after) return Error{path, kind_name(session_->vehicle), "a differential drive"};
  return write_ros2_diff_drive_yaml(path, *before, *after);
}

void GuideDesk::advance(double wall_s) {
  if (!changed_) return;
  unsaved_s_ += wall_s;
  if (unsaved_s_ >= kSaveAfter_s) save();
}

void GuideDesk::save() {
  if (!changed_ || !session_ || file_.empty()) return;
  const Result<Done> done = write_guide_session(file_, *session_);
  if (done)
    changed_ = false;
  else
    problem_ = "This session could not be saved: " + done.error().message();
  unsaved_s_ = 0.0;
}

void GuideDesk::look_for_saved() {
  saved_.clear();
  std::vector<std::pair<fs::file_time_type, std::string>> files;
  std::error_code none;
  if (folder_.empty()) return;
  for (const auto& entry : fs::directory_iterator(folder_, none))
    if (entry.path().extension() == ".toml")
      files.emplace_back(fs::last_write_time(entry, none), entry.path().string());
  std::sort(files.rbegin(), files.rend());
  for (const auto& [time, path] : files) {
    const Result<GuideSession> read = read_guide_session(path);
    if (!read) continue;
    const Guide& guide = guide_of(read->kind);
    saved_.push_back({path, guide.name + ", " + read->vehicle.name,
                      "page " + std::to_string(read->page + 1) + " of " + std::to_string(guide.pages.size()) + ", " +
                          guide.pages[std::size_t(read->page)].title});
    if (saved_.size() == 6) break;
  }
}

ui::GuideView GuideDesk::view(const Jobs& jobs) const {
  ui::GuideView v;
  v.saved = saved_;
  v.problem = problem_;
  v.busy = jobs.running();
  v.job = jobs.name();
  v.share_done = jobs.share_done();
  v.file = file_;
  v.all_saved = !changed_;
  if (!session_) return v;
  v.session = &*session_;
  v.outcome = &outcome_;
  v.experiments = &experiments_;
  v.vehicle_files = vehicle_files_;
  if (const GuideRound* round = round_on(*session_, task())) v.misfits = misfits(*round);
  if (!session_->real_robot) {
    v.rough_floor = scenario_.floor.roughness.largest_height_m > 0.0;
    if (const auto* drive = std::get_if<DifferentialDrive>(&session_->vehicle.kind)) {
      DifferentialDrive actual = *drive;
      actual.wheel_radius_left_m = scenario_.actual.wheel_radius_left_m;
      actual.wheel_radius_right_m = scenario_.actual.wheel_radius_right_m;
      actual.wheelbase_m = scenario_.actual.wheelbase_m;
      v.actual = session_->vehicle;
      v.actual->kind = actual;
    } else {
      v.actual = actual_;
    }
    if (std::holds_alternative<OmniMate>(session_->vehicle.kind))
      v.can_simulate = "The simulation of this guide drives a CLAPPER; the OmniMate can be calibrated from recordings.";
  }
  return v;
}

}  // namespace odolab
