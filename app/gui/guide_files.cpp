// The sessions of guides on the disk: begun, gone on with, written as they grow, and listed.
#include <algorithm>
#include <ctime>
#include <filesystem>

#include "app/gui/guide_desk.h"
#include "core/io/guide_toml.h"
#include "core/io/scenario_toml.h"
#include "physics/experiments/castor_prototype.h"

namespace odolab {

namespace {

constexpr double kSaveGuideAfter_s = 0.4;  // of changes: less than the second that may be lost

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

void GuideDesk::advance(double wall_s) {
  if (!changed_) return;
  unsaved_s_ += wall_s;
  if (unsaved_s_ >= kSaveGuideAfter_s) save();
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

}  // namespace odolab
