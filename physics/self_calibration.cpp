#include "physics/self_calibration.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "physics/simulation.h"

namespace odolab {

namespace {

constexpr double kCalibrationPatience = 3.0;  // times the planned duration, then it counts as lost

// The robot where it stands, with what it has learned so far.
class Calibrand {
 public:
  Calibrand(const Scenario& scenario, std::uint64_t seed) : scenario_(scenario), seed_(seed) {
    scenario_.sensors.truth_period_s = 0.0;
    true_pose_ = scenario.start;
  }

  // Drives a path from where it stands. Returns what Eq. 3.1 says of it: the sonar's motion less the believed one.
  ReturnError drive(const Path& path, SelfCalibration& log) {
    Scenario part = scenario_;
    part.start = true_pose_;
    part.path = path;
    Simulation simulation(part, seed_of_stream(seed_, ++drives_));
    const double longest_s = kCalibrationPatience * simulation.expected_duration_s();
    while (!simulation.state().finished && simulation.state().time_s < longest_s) simulation.step();
    log.lost = log.lost || !simulation.state().finished;
    log.duration_s += simulation.state().time_s;
    const Track& track = simulation.true_track();
    for (std::size_t i = 1; i < track.size(); ++i)
      log.driven_m += length(track[i].pose.position() - track[i - 1].pose.position());
    true_pose_ = simulation.state().true_pose;
    measured_pose_ = simulation.measured_end();
    log.farthest_from_corner_m =
        std::max(log.farthest_from_corner_m, length(true_pose_.position() - scenario_.start.position()));
    const Pose driven = between(part.start, simulation.state().estimated_pose);
    const Pose measured = between(simulation.measured_start(), simulation.measured_end());
    calculated_m_ = length(driven.position());
    return {measured.x_m - driven.x_m, measured.y_m - driven.y_m, wrapped(measured.heading_rad - driven.heading_rad)};
  }

  // Back to the start, by the pose that the sonar gave: first to a point behind it, then straight up.
  void come_home(double approach_m, SelfCalibration& log) {
    const Pose true_T_believed = true_pose_ * inverse(measured_pose_);
    const Vec2 behind = scenario_.start * Vec2{-approach_m, 0.0};
    drive(WaypointPath{{true_T_believed * behind, true_T_believed * scenario_.start.position()}}, log);
  }

  void believe(const DifferentialDrive& drive) { scenario_.vehicle.kind = drive; }
  const DifferentialDrive& believed() const { return std::get<DifferentialDrive>(scenario_.vehicle.kind); }
  void stand_at_start() { true_pose_ = measured_pose_ = scenario_.start; }
  const Pose& true_pose() const { return true_pose_; }
  double calculated_m() const { return calculated_m_; }

 private:
  Scenario scenario_;
  std::uint64_t seed_;
  std::uint64_t drives_ = 0;
  Pose true_pose_, measured_pose_;
  double calculated_m_ = 0.0;  // how far the last drive ended from where it began, as the robot believes
};

// The straight drive that a person measures.
ScaleCalibration taped(Calibrand& robot, const SelfCalibrationPlan& plan, Random& tape, SelfCalibration& log) {
  const Vec2 from = robot.true_pose().position();
  robot.drive(StraightPath{plan.tape_drive_m, false}, log);
  const double actual_m = length(robot.true_pose().position() - from) + plan.tape_accuracy_m * tape.normal();
  return *calibrate_scale({robot.calculated_m(), actual_m, plan.tape_accuracy_m}, robot.believed());
}

}  // namespace

std::optional<SelfCalibration> self_calibrate(const Scenario& scenario, const SelfCalibrationPlan& plan,
                                              std::uint64_t seed, const Progress& progress) {
  SelfCalibration result;
  Calibrand robot(scenario, seed_of_stream(seed, 1));
  Random tape(seed_of_stream(seed, 2));
  if (plan.tape_drive_m > 0.0) {
    result.scale = taped(robot, plan, tape, result);
    robot.believe(result.scale->corrected);
  }
  robot.stand_at_start();  // the person's other task
  result.farthest_from_corner_m = 0.0;
  const double side_m = std::get<SquarePath>(scenario.path).side_m;
  const int runs = 2 * plan.runs_each_way;
  for (int k = 0; k < plan.most_rounds; ++k) {
    SelfCalibrationRound round;
    round.nominal = robot.believed();
    round.runs.side_m = side_m;
    for (int i = 0; i < runs && !result.lost; ++i) {
      const bool clockwise = i % 2 == 0;
      const ReturnError error = robot.drive(SquarePath{side_m, clockwise}, result);
      (clockwise ? round.runs.clockwise : round.runs.counter_clockwise).push_back(error);
      robot.come_home(plan.approach_m, result);
      if (!goes_on(progress, (k + (i + 1.0) / runs) / plan.most_rounds)) return std::nullopt;
    }
    if (result.lost) return result;
    round.measure = *measure_umbmark(round.runs);
    const bool last = k + 1 == plan.most_rounds || (k > 0 && !round.measure.worth_compensating);
    if (!last) round.calibration = calibrate_umbmark(round.runs, round.nominal);
    result.rounds.push_back(round);
    if (!round.calibration) break;
    robot.believe(round.calibration->corrected);
  }
  result.found = robot.believed();
  goes_on(progress, 1.0);
  return result;
}

}  // namespace odolab
