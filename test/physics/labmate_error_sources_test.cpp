// The error sources of the UMBmark report, section 2, that a LabMate in a plane can have. Those with files of their own
// are tested there: unequal diameters and wheelbase in benchmark_test, misalignment in wheel_effects_test (wheel toe),
// uneven floor, objects and slippery floor in simulation_test, pushes and castor forces in vehicle_effects_test.
#include <gtest/gtest.h>

#include "test/physics/effects/effect_runs.h"

namespace odolab {
namespace {

constexpr double kGravity = 9.81;

TEST(LabMateErrors, AMeanDiameterThatIsTooLargeScalesTheWay) {
  Scenario scenario;
  scenario.path = StraightPath{4.0, false};
  scenario.actual.wheel_radius_left_m *= 1.01;
  scenario.actual.wheel_radius_right_m *= 1.01;
  EXPECT_NEAR(end_pose(scenario).x_m, 4.04, 0.001);  // the driver stops within 0.5 mm, a count is 0.2 mm
}

TEST(LabMateErrors, OverAccelerationSlipsByWhatCoulombsLawLacks) {
  constexpr double kSpeed = 0.4, kRamp_s = 0.1, kFriction = 0.05;
  Scenario scenario = table_drive({phase(6.0, kSpeed, 0.0)}, {});
  std::get<WheelSpeedPath>(scenario.path).ramp_s = kRamp_s;
  scenario.floor.friction = kFriction;
  Simulation simulation(scenario, 1);
  run_to_end(simulation, 5.0);
  // The drive wheels carry 0.7 of the weight: 0.34 m/s^2 instead of 4, and so the speed is reached a second late.
  const double grip_mps2 = kFriction * kGravity * scenario.actual.drive_wheel_load_share;
  const double lost_m = 0.5 * kSpeed * (kSpeed / grip_mps2 - kRamp_s);  // 212 mm
  EXPECT_NEAR(simulation.state().estimated_pose.x_m - simulation.state().true_pose.x_m, lost_m, 0.005 * lost_m);
}

TEST(LabMateErrors, FastTurningSkidsWhereTheArcAsksForMoreThanTheGrip) {
  constexpr double kSpeed = 0.6, kYawRate = 1.2, kFriction = 0.08;
  Scenario scenario = table_drive({phase(8.0, kSpeed, kYawRate)}, {});
  const double asked_mps2 = kSpeed * kYawRate;  // 0.72 m/s^2
  // With enough grip it follows the arc to the end of the phase.
  Simulation holding(scenario, 1);
  run_to_end(holding, 8.0);
  EXPECT_NEAR(length(holding.state().true_pose.position() - holding.state().estimated_pose.position()), 0.0, 0.002);
  // With less, the centre's path cannot curve more than the grip allows, and the odometry does not know.
  scenario.floor.friction = kFriction;
  const double grip_mps2 = kFriction * kGravity * scenario.actual.drive_wheel_load_share;  // 0.55 m/s^2
  ASSERT_LT(grip_mps2, asked_mps2);
  Simulation skidding(scenario, 1);
  run_to_end(skidding, 4.0);
  double largest_mps2 = 0.0;
  Vec2 before = skidding.state().true_pose.position(), velocity_before{};
  for (int i = 0; i < 3000; ++i) {
    skidding.step();
    const Vec2 now = skidding.state().true_pose.position();
    const Vec2 velocity = (1.0 / scenario.step_s) * (now - before);
    if (i > 0) largest_mps2 = std::max(largest_mps2, length(velocity - velocity_before) / scenario.step_s);
    before = now;
    velocity_before = velocity;
  }
  EXPECT_LT(largest_mps2, 1.02 * grip_mps2);  // single precision of the forces and the differences
  EXPECT_GT(length(skidding.state().true_pose.position() - skidding.state().estimated_pose.position()), 0.05);
}

TEST(LabMateErrors, CoarseEncodersErrByLessThanACount) {
  Scenario scenario = table_drive({phase(3.0, 0.3, 0.0), phase(3.0, 0.2, 0.4)}, {});
  DifferentialDrive coarse;
  coarse.encoder_counts_per_revolution = 100.0;
  scenario.vehicle.kind = coarse;
  const Simulation simulation = finished(scenario);
  const double count_m = 2.0 * kPi * kRadius_m / 100.0;  // 4.7 mm
  const Pose &truth = simulation.state().true_pose, &believed = simulation.state().estimated_pose;
  const double heading_error_rad = std::abs(truth.heading_rad - believed.heading_rad);
  EXPECT_GT(heading_error_rad, 0.0);
  EXPECT_LE(heading_error_rad, 2.0 * count_m / kBase_m);  // a count of each wheel
  // A count along, and the heading's tremble of a count over the way of 1.5 m across.
  EXPECT_LE(length(truth.position() - believed.position()), count_m + 1.5 * 2.0 * count_m / kBase_m);
}

TEST(LabMateErrors, SlowSamplingLaysArcsDownAsChords) {
  constexpr double kSpeed = 0.4, kYawRate = 0.8, kPeriod_s = 0.5;
  Scenario scenario = table_drive({phase(8.0, kSpeed, kYawRate)}, {});
  scenario.sensors.encoder_period_s = kPeriod_s;
  DifferentialDrive fine;
  fine.encoder_counts_per_revolution = 1e7;
  scenario.vehicle.kind = fine;
  const Simulation simulation = finished(scenario);
  const auto chord = [&](const Track& track) {
    return length(track.at(10).pose.position() - track.at(4).pose.position());  // from 2 to 5 s: steady
  };
  // The way of a period laid down straight at the middle heading: its arc has the radius v T / (2 sin(w T / 2)).
  const double stretched = 0.5 * kYawRate * kPeriod_s / std::sin(0.5 * kYawRate * kPeriod_s);  // 1.0067
  EXPECT_NEAR(chord(simulation.estimated_track()) / chord(simulation.true_track()), stretched, 2e-5);
}

// Wheels that climb 2 mm every 6 cm slip for a moment at a time. A motor that feels the floor a step late falls into a
// limit cycle of slipping one way and the other there: 1.7 degrees in 4 m at 2 ms from this seed.
TEST(LabMateErrors, MotorsFindTheirGripAgainOnARoughFloor) {
  std::vector<double> headings_rad;
  for (const double step_s : {0.002, 0.001}) {
    Scenario scenario;
    scenario.path = StraightPath{4.0, false};
    scenario.floor.roughness = {0.0022, 0.06};
    scenario.step_s = step_s;
    Simulation simulation(scenario, 3);
    run_to_end(simulation, 60.0);
    headings_rad.push_back(simulation.state().true_pose.heading_rad);
  }
  // A bump begins within a step of 0.4 mm with up to 0.2 of it at once: 130 times 0.08 mm at random over 340 mm,
  // halved.
  EXPECT_NEAR(headings_rad[0], headings_rad[1], radians(0.05));
}

}  // namespace
}  // namespace odolab
