#include <gtest/gtest.h>

#include "core/odometry/synchro_step.h"
#include "core/recording/vehicle_samples.h"
#include "physics/ground.h"
#include "physics/simulation.h"
#include "test/support/finished_run.h"

namespace odolab {
namespace {

constexpr double kCircle_m = 0.25, kSynchroRadius_m = 0.127, kHeight_m = 0.010;

// Fine encoders: a steering count of 3.1 mrad would hide what the tests look for.
const SynchroDrive kFine = {.drive_counts_per_revolution = 1e6, .steering_counts_per_revolution = 1e6};

Scenario k2a(const Path& path) {
  Scenario scenario;
  scenario.vehicle.name = "K2A";
  scenario.vehicle.kind = kFine;
  scenario.motor.ideal = true;  // a LabMate's motor is weak for 125 kg, and the driver would swing past his stops
  scenario.path = path;
  scenario.actual.mass_kg = 125.0;
  scenario.actual.moment_of_inertia_kgm2 = 8.0;
  scenario.step_s = 0.002;
  return scenario;
}

void put_cable_under(Scenario& scenario, Under under) {
  Bump cable;
  cable.centre = {1.0, 0.0};
  cable.length_m = 2.0;
  cable.height_m = kHeight_m;
  cable.under = under;
  scenario.floor.bumps.push_back(cable);
}

// By how much the forward speeds of three wheels, as shares of their mean, turn a base on creeping wheels for each
// metre: the least squares fit of a rigid motion, sum(-share_i y_i) / (3 rho^2).
double turn_per_metre(double front, double left, double right) {
  const double y_left_m = kCircle_m * std::sin(2.0 * kPi / 3.0);
  (void)front;  // on the middle line while the wheels point along the base
  return (right - left) * y_left_m / (3.0 * kCircle_m * kCircle_m);
}

Pose reckoned(const Recording& recording, const SynchroDrive& drive) {
  const std::vector<SynchroSample> samples = synchro_samples(recording);
  SynchroPose at;
  for (std::size_t i = 1; i < samples.size(); ++i)
    at = dead_reckoned(at, samples[i].wheel_rad - samples[i - 1].wheel_rad,
                       samples[i].steering_rad - samples[i - 1].steering_rad, drive);
  return at.pose;
}

TEST(SynchroDrive, ReturnsToItsStartByTheEncodersOfItsTwoMotors) {
  for (const bool clockwise : {true, false}) {
    const Simulation simulation = finished(k2a(SquarePath{2.0, clockwise}));
    const Pose& end = simulation.state().true_pose;
    EXPECT_LT(length(end.position()), 0.006);  // the driver stops within 0.5 mm and 0.5 mrad, four times, 2 m apart
    EXPECT_NEAR(end.heading_rad, clockwise ? -2.0 * kPi : 2.0 * kPi, 0.003);
    // Speeding up creeps by 0.17 % of 10 cm and braking as much back: eight times 0.17 mm where nothing cancels.
    EXPECT_NEAR(simulation.state().estimated_pose.x_m, end.x_m, 1.4e-3);
    EXPECT_NEAR(simulation.state().estimated_pose.y_m, end.y_m, 1.4e-3);
  }
}

// In the direction of 150 degrees of the base. The two wheels that agree must hold the third against its slip: by the
// balance of forces and torque with 0.87 of their grip there, but with all of it within 60 degrees of straight ahead,
// where Coulomb's law leaves open which wheel slips.
TEST(SynchroDrive, ABumpUnderOneHardWheelMakesThatWheelSlipAndNotTheRobotTurn) {
  constexpr double kWay_rad = 5.0 * kPi / 6.0;
  const Vec2 ahead{std::cos(kWay_rad), std::sin(kWay_rad)};
  Scenario scenario = k2a(WaypointPath{{2.0 * ahead}});
  scenario.machine.synchro.creep_stiffness = 0.0;
  Bump cable;
  cable.centre = ahead;
  cable.direction_rad = kWay_rad + 0.5 * kPi;
  cable.length_m = 2.0;
  cable.height_m = kHeight_m;
  cable.under = Under::left_wheel;
  scenario.floor.bumps.push_back(cable);
  Simulation simulation(scenario, 1);
  double left_slip_m = 0.0, right_slip_m = 0.0;
  while (!simulation.state().finished) {
    simulation.step();
    left_slip_m += simulation.state().left.slip_speed_mps * scenario.step_s;
    right_slip_m += simulation.state().right.slip_speed_mps * scenario.step_s;
  }
  // The others drag it over the bump at the speed at which it rolls, so that it lacks the integral of 1 - sqrt(R^2 -
  // u^2)/R over the way of the bump: 2.55 mm. Steps of 2 ms in half a second: a hundredth.
  const double reach_m = std::sqrt(2.0 * kSynchroRadius_m * kHeight_m - kHeight_m * kHeight_m);
  const double extra_m = 2.0 * reach_m -
                         reach_m * std::sqrt(1.0 - reach_m * reach_m / (kSynchroRadius_m * kSynchroRadius_m)) -
                         kSynchroRadius_m * std::asin(reach_m / kSynchroRadius_m);
  EXPECT_NEAR(left_slip_m, -extra_m, 0.01 * extra_m);
  EXPECT_NEAR(right_slip_m, 0.0, 0.01 * extra_m);
  const SimulationState& end = simulation.state();
  EXPECT_NEAR(end.true_pose.heading_rad, end.estimated_pose.heading_rad, 5e-5);  // on rubber 1.8e-3
  EXPECT_LT(length(end.true_pose.position() - end.estimated_pose.position()), 2e-4);
}

TEST(SynchroDrive, ABumpUnderOneRubberWheelTurnsTheBaseByTheLeastSquaresOfAllThree) {
  Scenario scenario = k2a(StraightPath{2.0});
  put_cable_under(scenario, Under::left_wheel);
  const Simulation simulation = finished(scenario);
  const double expected_rad = -turn_per_metre(0.0, extra_roll_m(kSynchroRadius_m, kHeight_m), 0.0);  // 3.1 mrad
  // The creep lags by its relaxation length, which adds nothing in the end; the slip of 8 % at the flank needs nearly
  // all of the grip, where creep is no longer small against it: a tenth.
  EXPECT_NEAR(simulation.state().true_pose.heading_rad, expected_rad, 0.1 * expected_rad);
}

TEST(SynchroDrive, UnequalWheelsTurnTheBaseOneWayOnTheWayOutAndBackOnTheWayBack) {
  Scenario scenario = k2a(StraightPath{4.0});
  scenario.machine.synchro.radius_error = {0.0, -0.001, 0.001};
  const double out_rad = finished(scenario).state().true_pose.heading_rad;
  EXPECT_NEAR(out_rad, 4.0 * turn_per_metre(0.0, -0.001, 0.001), 0.02 * out_rad);  // creep builds up over 5 cm of 4 m
  // Turned by half a turn the wheels drive the base the other way; its heading comes back.
  scenario.path = WaypointPath{{{4.0, 0.0}, {0.0, 0.0}}};
  const Pose end = finished(scenario).state().true_pose;
  EXPECT_NEAR(wrapped(end.heading_rad - kPi), 0.0, 0.02 * out_rad + 0.0005);  // the driver's last 0.5 mrad
}

TEST(SynchroDrive, OdometryThatKnowsTheBaseTurnFollowsUnequalAndMisalignedWheels) {
  Scenario scenario = k2a(SquarePath{3.0, false});
  scenario.machine.synchro.radius_error = {0.0005, -0.001, 0.0005};
  scenario.machine.synchro.misalignment_rad = {0.001, -0.001, 0.0};
  SynchroDrive known = kFine;
  const double third = 1.0 / (3.0 * kCircle_m * kCircle_m);
  const double x_m[] = {kCircle_m, -0.5 * kCircle_m, -0.5 * kCircle_m};
  const double y_m[] = {0.0, kCircle_m * std::sin(2.0 * kPi / 3.0), -kCircle_m * std::sin(2.0 * kPi / 3.0)};
  for (int i = 0; i < 3; ++i) {
    const double share = scenario.machine.synchro.radius_error[static_cast<std::size_t>(i)];
    const double toe = scenario.machine.synchro.misalignment_rad[static_cast<std::size_t>(i)];
    known.base_turn_cos_rad_per_m += third * (toe * x_m[i] - share * y_m[i]);
    known.base_turn_sin_rad_per_m += third * (toe * y_m[i] + share * x_m[i]);
  }
  const Simulation simulation = finished(scenario);
  const Pose& end = simulation.state().true_pose;
  const Pose without = reckoned(simulation.recording(), std::get<SynchroDrive>(scenario.vehicle.kind));
  const Pose with = reckoned(simulation.recording(), known);
  EXPECT_GT(length(without.position() - end.position()), 0.020);
  // Creep builds up anew after each corner: 5 cm of 3 m in each side.
  EXPECT_LT(length(with.position() - end.position()), 0.05 * length(without.position() - end.position()));
}

TEST(SynchroDrive, ASteeringRatioTurnsTooLittleInBothDirections) {
  Scenario scenario = k2a(SquarePath{2.0, false});
  SynchroDrive actual = kFine;
  actual.steering_ratio = 1.01;
  scenario.machine.lengths = actual;
  EXPECT_NEAR(finished(scenario).state().true_pose.heading_rad, 2.0 * kPi / 1.01, 0.004);
  scenario.path = SquarePath{2.0, true};
  EXPECT_NEAR(finished(scenario).state().true_pose.heading_rad, -2.0 * kPi / 1.01, 0.004);
}

}  // namespace
}  // namespace odolab
