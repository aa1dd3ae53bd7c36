#include <gtest/gtest.h>

#include <algorithm>

#include "core/odometry/cast.h"
#include "physics/simulation.h"

namespace odolab {
namespace {

// Encoders without steps.
Scenario three_castors(Path path) {
  Scenario scenario;
  MultiCastor vehicle = three_castor_vehicle();
  vehicle.wheel_encoder_resolution_rad = vehicle.pivot_encoder_resolution_rad = 0.0;
  scenario.vehicle.kind = vehicle;
  scenario.path = std::move(path);
  scenario.driving = {0.3, 0.75, 0.2, 1.0, 0.0, true};
  scenario.sensors.encoder_period_s = 0.050;
  return scenario;
}

TEST(MultiCastor, GoesSidewaysAndAboutItselfAndItsCastorsStayOnTheirPivots) {
  const ManoeuvrePath path{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.5 * kPi}, {-0.5, 0.5, 0.0}}};
  Scenario scenario = three_castors(path);
  Simulation simulation(scenario, 1);
  const MultiCastor& vehicle = std::get<MultiCastor>(scenario.vehicle.kind);
  double largest_gap_m = 0.0;
  while (!simulation.state().finished && simulation.state().time_s < 100.0) {
    simulation.step();
    for (std::size_t i = 0; i < vehicle.castors.size(); ++i) {
      const Vec2 by_platform = simulation.state().true_pose * vehicle.castors[i].pivot();
      const Vec2 by_castor = simulation.state().other_bodies[i] * Vec2{vehicle.castors[i].offset_m, 0.0};
      largest_gap_m = std::max(largest_gap_m, length(by_platform - by_castor));
    }
  }
  ASSERT_TRUE(simulation.state().finished);
  EXPECT_LT(largest_gap_m, 1e-6);  // three pins share the platform: two sweeps leave some of each other's correction
  // (1, 0), (1, 1) and a quarter turn, then (-0.5, 0.5) turned by it.
  EXPECT_NEAR(simulation.state().true_pose.x_m, 0.5, 5e-3);
  EXPECT_NEAR(simulation.state().true_pose.y_m, 0.5, 5e-3);
  EXPECT_NEAR(simulation.state().true_pose.heading_rad, 0.5 * kPi, 5e-3);
  // A castor trails behind the motion: its axis points along the way of its pivot, here backward and to the left.
  const double along_rad = simulation.state().true_pose.heading_rad + std::atan2(0.5, -0.5);
  for (const Pose& castor : simulation.state().other_bodies)
    EXPECT_NEAR(wrapped(castor.heading_rad - along_rad), 0.0, 0.02);  // e^(-0.71 m / 0.05 m), and the driver's ripple
  RecordProperty("gap_nm", std::to_string(1e9 * largest_gap_m));
}

TEST(MultiCastor, CastFollowsTheTruthOnASquare) {
  Scenario scenario = three_castors(SquarePath{1.5, false});
  Simulation simulation(scenario, 1);
  run_to_end(simulation, 200.0);
  ASSERT_TRUE(simulation.state().finished);
  const Pose gap = between(simulation.state().true_pose, simulation.state().estimated_pose);
  // Castors that swing round at the corners in some 0.2 s, sampled each 50 ms: what Eqs. 13 and 14 leave there, about
  // a millimetre a corner.
  EXPECT_LT(length(gap.position()), 10e-3);
  EXPECT_LT(std::abs(gap.heading_rad), 0.02);
  RecordProperty("gap_mm", std::to_string(1e3 * length(gap.position())));
  RecordProperty("gap_rad", std::to_string(gap.heading_rad));
}

TEST(MultiCastor, EndPoseOnTheSquareConvergesWhenTheStepIsHalved) {
  std::vector<Vec2> ends;
  for (const double step_s : {0.005, 0.0025, 0.00125}) {
    Scenario scenario = three_castors(SquarePath{1.5, false});
    scenario.step_s = step_s;
    Simulation simulation(scenario, 1);
    run_to_end(simulation, 200.0);
    ends.push_back(simulation.state().true_pose.position());
  }
  // 0.03 and 0.01 mm; by wheel speeds for the castors' angles at the step's start, not its middle, 1.1 and 0.6.
  EXPECT_LT(length(ends[1] - ends[0]), 0.1e-3);
  EXPECT_LT(length(ends[2] - ends[1]), 0.1e-3);
}

TEST(MultiCastor, WheelsSlipHardlyWhereTheCommandsAreConsistent) {
  Scenario scenario = three_castors(FigureEightPath{1.0, 1});
  Simulation simulation(scenario, 1);
  double slip_m = 0.0;
  while (!simulation.state().finished && simulation.state().time_s < 100.0) {
    simulation.step();
    slip_m += std::abs(simulation.state().left.slip_speed_mps) * scenario.step_s;
  }
  ASSERT_TRUE(simulation.state().finished);
  EXPECT_LT(slip_m, 0.2e-3);  // of 12.6 m: wheels that turn as the rigid motion asks have nothing to slip for
  RecordProperty("slip_mm", std::to_string(1e3 * slip_m));
}

}  // namespace
}  // namespace odolab
