#include "app/gui/guide_desk.h"

#include <algorithm>
#include <filesystem>

#include "core/guide/misfit.h"
#include "core/io/guide_report.h"
#include "core/io/ros2_yaml.h"
#include "core/io/vehicle_toml.h"

namespace odolab {

namespace {

constexpr std::size_t kMostGuideUndo = 100;

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
  for (const auto& entry : std::filesystem::directory_iterator(std::string(ODOLAB_ASSETS) + "/vehicles", none))
    if (const Result<Vehicle> vehicle = read_vehicle(entry.path().string());
        vehicle && why_not(guide_of(session.kind), *vehicle).empty())
      vehicle_files_.push_back(entry.path().string());
  std::sort(vehicle_files_.begin(), vehicle_files_.end());
  reckon();
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
  if (undo_.size() > kMostGuideUndo) undo_.erase(undo_.begin());
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
