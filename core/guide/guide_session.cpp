#include "core/guide/guide_session.h"

#include <algorithm>
#include <cmath>

namespace odolab {

ReturnError return_error(const GuideRun& run) {
  return {run.measured.x_m - run.odometry.x_m, run.measured.y_m - run.odometry.y_m,
          run.has_heading ? wrapped(run.measured.heading_rad - run.odometry.heading_rad) : 0.0};
}

DifferentialDrive first_nominal(const GuideSession& session) {
  const DifferentialDrive* drive = std::get_if<DifferentialDrive>(&session.vehicle.kind);
  const DifferentialDrive nominal = drive ? *drive : DifferentialDrive{};
  if (!session.tape) return nominal;
  const std::optional<ScaleCalibration> scale = calibrate_scale(*session.tape, nominal);
  return scale ? scale->corrected : nominal;
}

const GuideRound* round_on(const GuideSession& session, PageTask task) {
  static const GuideRound empty;
  switch (task) {
    case PageTask::runs:
      return session.rounds.empty() ? &empty : &session.rounds.front();
    case PageTask::again:
    case PageTask::verdict:
      return session.rounds.size() < 2 ? &empty : &session.rounds.back();
    case PageTask::bumps:
      return &session.bumped;
    default:
      return nullptr;
  }
}

void enter_run(GuideSession& session, PageTask task, const GuideRun& run) {
  if (task == PageTask::runs) {
    if (session.rounds.empty()) session.rounds.emplace_back();
    if (session.rounds.front().runs.empty()) session.rounds.front().nominal = first_nominal(session);
    session.rounds.front().runs.push_back(run);
  } else if (task == PageTask::again && session.rounds.size() > 1) {
    session.rounds.back().runs.push_back(run);
  } else if (task == PageTask::bumps) {
    if (session.bumped.runs.empty()) session.bumped.nominal = first_nominal(session);
    session.bumped.runs.push_back(run);
  }
}

int counted(const GuideRound& round, bool clockwise) {
  return static_cast<int>(std::count_if(round.runs.begin(), round.runs.end(), [clockwise](const GuideRun& r) {
    return r.clockwise == clockwise && !r.left_out;
  }));
}

bool next_is_clockwise(const GuideRound& round) { return counted(round, true) <= counted(round, false); }

UmbmarkRuns umbmark_runs(const GuideRound& round, double side_m) {
  UmbmarkRuns runs;
  runs.side_m = side_m;
  for (const GuideRun& run : round.runs)
    if (!run.left_out) (run.clockwise ? runs.clockwise : runs.counter_clockwise).push_back(return_error(run));
  return runs;
}

bool compensate(GuideSession& session) {
  if (session.rounds.empty()) return false;
  const GuideRound& last = session.rounds.back();
  const auto calibration = calibrate_umbmark(umbmark_runs(last, session.side_m), last.nominal);
  if (!calibration) return false;
  GuideRound next;
  next.nominal = calibration->corrected;
  session.rounds.push_back(next);
  return true;
}

void turn_to(GuideSession& session, int page) {
  const Guide& guide = guide_of(session.kind);
  session.page = std::clamp(page, 0, static_cast<int>(guide.pages.size()) - 1);
  session.reached = std::max(session.reached, session.page);
  if (guide.pages[static_cast<std::size_t>(session.page)].task == PageTask::again && session.rounds.size() == 1)
    compensate(session);
}

std::string still_to_do(const GuideSession& session) {
  const Guide& guide = guide_of(session.kind);
  const PageTask task = guide.pages[static_cast<std::size_t>(session.page)].task;
  if (const GuideRound* round = round_on(session, task)) {
    const int cw = counted(*round, true), ccw = counted(*round, false);
    if (cw == 0 || ccw == 0)
      return cw == 0 && ccw == 0 ? "One run each way is needed at least."
             : cw == 0           ? "A clockwise run is needed."
                                 : "A counter-clockwise run is needed.";
    if (session.kind == GuideKind::extended_umbmark)
      for (const GuideRun& run : round->runs)
        if (!run.left_out && !run.has_heading)
          return "A run has no heading, and the heading is what extended UMBmark is about.";
    return "";
  }
  if (task == PageTask::robot) {
    const std::vector<std::string> problems = problems_in(session.vehicle.kind);
    return problems.empty() ? why_not(guide, session.vehicle) : problems.front();
  }
  if (task == PageTask::recordings && session.recordings.empty()) return "A recording is needed.";
  return "";
}

std::vector<std::string> problems_in(const GuideSession& session) {
  std::vector<std::string> problems;
  const int pages = static_cast<int>(guide_of(session.kind).pages.size());
  if (session.page < 0 || session.page >= pages)
    problems.push_back("page: found " + std::to_string(session.page + 1) + ", expected one from 1 to " +
                       std::to_string(pages));
  if (session.reached < session.page || session.reached >= pages)
    problems.push_back("reached: found " + std::to_string(session.reached + 1) + ", expected one from the page on to " +
                       std::to_string(pages));
  if (!(session.side_m > 0.0)) problems.push_back("side_m: found no length, expected one above 0 m");
  if (session.runs_each_way < 1) problems.push_back("runs_each_way: found less than 1, expected 1 or more");
  if (session.tape && !(session.tape->calculated_m > 0.0 && session.tape->actual_m > 0.0))
    problems.push_back("tape: found a distance that is not above 0 m, expected two distances");
  for (const std::string& problem : problems_in(session.vehicle.kind)) problems.push_back("vehicle." + problem);
  return problems;
}

}  // namespace odolab
