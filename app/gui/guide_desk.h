// The guide that is open: what has been entered, what came of it, and its file, which is written as it grows.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/jobs.h"
#include "core/guide/guide_session.h"
#include "core/guide/outcome.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "ui/actions.h"
#include "ui/guide.h"

namespace odolab {

class GuideDesk {
 public:
  // `folder` keeps the sessions; empty: they are not kept, as where pictures must always be the same.
  explicit GuideDesk(std::string folder) : folder_(std::move(folder)) {}
  ~GuideDesk() { save(); }
  GuideDesk(const GuideDesk&) = delete;
  GuideDesk& operator=(const GuideDesk&) = delete;

  // A new session about the vehicle of this scenario, or the usual one of the guide where it cannot be calibrated so.
  void begin(GuideKind kind, bool real_robot, const Scenario& scenario);
  Result<Done> resume(const std::string& path, Jobs& jobs);
  void leave();
  void change(const ui::ChangeGuide& change, Jobs& jobs);
  // Steps back and forth through what was entered, dropped or driven since the session was opened; page and all.
  void undo(Jobs& jobs) { step(undo_, redo_, jobs); }
  void redo(Jobs& jobs) { step(redo_, undo_, jobs); }
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  Result<Done> choose_vehicle(const std::string& path, Jobs& jobs);
  // What the page asks for, driven by the simulated robot in a job.
  void drive(Jobs& jobs);
  // A recording that was dropped: a run of squares, or one of the recordings of a calibration from the inside.
  Result<Done> take(const std::string& path, const Recording& recording, Jobs& jobs);
  Result<Done> write(ui::GuideExport what, const std::string& path) const;

  // Once for each picture: writes what has changed, at most twice a second.
  void advance(double wall_s);
  void save();

  void show(bool on);  // in Calibrate, instead of the bench
  bool shown() const { return shown_; }
  bool is_open() const { return session_.has_value(); }
  const GuideSession& session() const { return *session_; }
  const std::string& file() const { return file_; }
  ui::GuideView view(const Jobs& jobs) const;

 private:
  PageTask task() const;
  std::uint64_t inside_seed() const;  // of the machine that a calibration from the inside is about
  void remember();
  void step(std::vector<GuideSession>& from, std::vector<GuideSession>& to, Jobs& jobs);
  void replace(const GuideSession& session, Jobs& jobs);
  void reckon();
  void read_recordings(Jobs& jobs);
  void drive_another_way(Jobs& jobs);
  std::string kept(const Recording& recording);
  void calibrate_inside(Jobs& jobs);
  void look_for_saved();
  void open(const GuideSession& session, const std::string& file);

  std::string folder_, file_;
  std::optional<GuideSession> session_;
  std::vector<GuideSession> undo_, redo_;
  Scenario scenario_;  // of the simulated robot
  GuideOutcome outcome_;
  std::vector<ui::BenchExperiment> experiments_;
  std::shared_ptr<const InternalCalibration> internal_;
  std::vector<Recording> held_out_;
  std::vector<Recording> recordings_;  // of a calibration from the inside, in the order of the session's files
  std::optional<Vehicle> actual_;
  std::vector<ui::SavedGuide> saved_;
  std::vector<std::string> vehicle_files_;  // of the project, those that the guide can calibrate
  std::string problem_;
  bool shown_ = false;
  bool changed_ = false;
  double unsaved_s_ = 0.0;  // for so long
};

}  // namespace odolab
