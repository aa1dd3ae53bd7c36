// What the simulated robot of a guide drives, each page in a job.
#include "physics/experiments/guide_drives.h"

#include "app/gui/guide_desk.h"
#include "core/base/random.h"
#include "core/calibration/internal.h"
#include "core/io/recording_csv.h"
#include "physics/benchmark.h"

namespace odolab {

std::uint64_t GuideDesk::inside_seed() const { return seed_of_stream(scenario_.seed, 100); }

// Writes a simulated recording beside the session, and returns its path; its name alone where nothing is kept.
std::string GuideDesk::kept(const Recording& recording) {
  if (file_.empty()) return recording.name;
  const std::string path = file_.substr(0, file_.size() - 5) + "-recordings/" + recording.name + ".csv";
  if (const Result<Done> done = write_recording_csv(path, recording); !done) problem_ = done.error().message();
  return path;
}

void GuideDesk::drive(Jobs& jobs) {
  if (!session_ || jobs.running()) return;
  const PageTask page = task();
  if (page == PageTask::again && session_->rounds.size() < 2) return;
  remember();
  problem_.clear();
  const std::uint64_t seed = seed_of_stream(scenario_.seed, 100 + 10 * session_->rounds.size() + std::uint64_t(page));
  if (page == PageTask::tape) {
    const double accuracy_m = session_->tape ? session_->tape->tape_accuracy_m : 0.001;
    Scenario scenario = scenario_;
    scenario.vehicle = session_->vehicle;
    const auto reading = std::make_shared<std::optional<TapeReading>>();
    jobs.start(
        "driving along the tape",
        [scenario, accuracy_m, seed, reading](const Progress& progress, const Jobs::Deliver&) {
          *reading = drive_along_tape(scenario, 4.0, accuracy_m, seed, progress);
        },
        [this, reading](bool cancelled) {
          if (cancelled || !session_) return;
          if (!*reading) {
            problem_ = "The robot did not arrive at the end of the tape: look at the floor in Drive.";
            return;
          }
          session_->tape = **reading;
          changed_ = true;
          reckon();
        });
    return;
  }
  if (page == PageTask::runs || page == PageTask::again || page == PageTask::bumps) {
    Scenario scenario = on_guide_square(scenario_, session_->side_m, session_->runs_each_way);
    if (page == PageTask::bumps) scenario.floor.bumps = ten_cables(session_->side_m);
    if (page == PageTask::runs) session_->rounds.assign(1, {});  // what followed from the old runs goes with them
    GuideRound& round = page == PageTask::bumps ? session_->bumped : session_->rounds.back();
    round.runs.clear();
    round.lost = 0;
    scenario.vehicle = session_->vehicle;
    scenario.vehicle.kind = page == PageTask::again ? round.nominal : first_nominal(*session_);
    jobs.start("driving the squares",
               [this, scenario, seed, page](const Progress& progress, const Jobs::Deliver& deliver) {
                 run_umbmark(
                     scenario, seed,
                     [this, page, &deliver](const BenchmarkRun& run) {
                       deliver([this, page, run] {
                         if (!session_) return;
                         GuideRun entry;
                         entry.clockwise = run.clockwise;
                         entry.measured = {run.error.x_m, run.error.y_m, run.error.heading_rad};
                         entry.has_heading = true;
                         entry.source = "simulated";
                         if (run.finished)
                           enter_run(*session_, page, entry);
                         else if (page == PageTask::bumps)
                           ++session_->bumped.lost;
                         else if (!session_->rounds.empty())
                           ++session_->rounds.back().lost;
                         changed_ = true;
                         reckon();
                       });
                     },
                     progress);
               },
               {});
    reckon();
    return;
  }
  if (page == PageTask::held_out) drive_another_way(jobs);
  if (page == PageTask::recordings) {
    const Vehicle nominal = session_->vehicle;
    const std::uint64_t inside = inside_seed();
    const auto drives = std::make_shared<InsideDrives>();
    const auto found = std::make_shared<std::optional<Result<InternalCalibration>>>();
    jobs.start(
        "driving, and calibrating from the inside",
        [nominal, inside, drives, found](const Progress& progress, const Jobs::Deliver&) {
          *drives = drive_for_calibration_from_inside(nominal, inside,
                                                      [&](double share) { return goes_on(progress, 0.8 * share); });
          if (drives->recordings.empty()) return;
          *found = calibrate_internally(drives->recordings, nominal,
                                        [&](double share) { return goes_on(progress, 0.8 + 0.2 * share); });
        },
        [this, drives, found](bool cancelled) {
          if (cancelled || !session_) return;
          if (!*found || !**found) {
            problem_ =
                *found ? (*found)->error().message() : "The simulation does not drive this kind of vehicle here.";
            return;
          }
          session_->recordings.clear();
          recordings_ = drives->recordings;
          for (const Recording& recording : recordings_) session_->recordings.push_back(kept(recording));
          actual_ = drives->actual;
          internal_ = std::make_shared<const InternalCalibration>(***found);
          changed_ = true;
          reckon();
        });
  }
}

void GuideDesk::drive_another_way(Jobs& jobs) {
  if (!outcome_.calibrated) return;
  const Vehicle believed = *outcome_.calibrated, actual = drawn_machine(session_->vehicle, inside_seed());
  const std::uint64_t seed = inside_seed();
  const auto driven = std::make_shared<std::optional<Recording>>();
  jobs.start(
      "driving another way",
      [believed, actual, seed, driven](const Progress& progress, const Jobs::Deliver&) {
        *driven = drive_held_out(believed, actual, seed, progress);
      },
      [this, driven](bool cancelled) {
        if (cancelled || !session_) return;
        if (!*driven) {
          problem_ = "The robot did not arrive.";
          return;
        }
        held_out_ = {**driven};
        session_->held_out = {kept(**driven)};
        changed_ = true;
        reckon();
      });
}

}  // namespace odolab
