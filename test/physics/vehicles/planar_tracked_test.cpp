#include <gtest/gtest.h>

#include <cmath>

#include "core/scenario/suited_scenario.h"
#include "physics/simulation.h"

namespace odolab {
namespace {

Scenario andros(const Path& path) {
  Scenario scenario;
  scenario.vehicle.name = "Andros";
  scenario.vehicle.kind = Tracked{};
  scenario.motor.ideal = true;  // skidding needs far more torque than a LabMate's motor has
  scenario.actual.mass_kg = 200.0;
  scenario.actual.moment_of_inertia_kgm2 = 20.0;
  scenario.path = path;
  scenario.step_s = 0.002;
  return scenario;
}

// Turns on the spot by hand for a while; returns what the tracks would turn a vehicle that does not slip, over what it
// turned.
double apparent_width(Scenario scenario, double yaw_rate_radps = 0.5) {
  scenario.path = HandPath{20.0};
  Simulation simulation(scenario, 1);
  simulation.drive_by_hand(0.0, yaw_rate_radps);
  run_to_end(simulation, 60.0);
  return simulation.state().estimated_pose.heading_rad / simulation.state().true_pose.heading_rad;
}

// The steady turn on the spot: the pads' Coulomb forces, each against its slip (u - w B/2 along, w x across), have no
// torque. Neither friction nor weight nor speed is in it. Found by bisection on r = u / (w B/2).
double apparent_width_by_torque(const ActualTracks& tracks) {
  const double half_m = 0.5 * Tracked{}.track_width_m;
  double low = 1.0, high = 10.0;
  for (int k = 0; k < 60; ++k) {
    const double r = 0.5 * (low + high);
    double torque = 0.0;
    for (int i = 0; i < tracks.pads; ++i) {
      const double x_m = tracks.contact_length_m * ((i + 0.5) / tracks.pads - 0.5);
      const double along = (r - 1.0) * half_m;
      torque += (half_m * along - x_m * x_m) / std::hypot(along, x_m);
    }
    (torque < 0.0 ? low : high) = r;
  }
  return low;
}

TEST(Tracked, DrivesStraightWithoutSlip) {
  Simulation simulation(andros(StraightPath{3.0}), 1);
  run_to_end(simulation, 100.0);
  EXPECT_NEAR(simulation.state().true_pose.x_m, 3.0, 0.001);
  EXPECT_NEAR(simulation.state().estimated_pose.x_m, simulation.state().true_pose.x_m, 4e-4);  // a count is 0.3 mm
}

TEST(Tracked, TracksOfOnePadTurnLikeWheels) {
  Scenario scenario = andros({});
  scenario.machine.tracks.pads = 1;
  EXPECT_NEAR(apparent_width(scenario), 1.0, 0.002);  // a count of 0.3 mm over 0.5 m, against 10 rad
}

TEST(Tracked, TurnsLessThanItsTracksByTheTorqueOfItsSkiddingPads) {
  Scenario scenario = andros({});
  const double expected = apparent_width_by_torque(scenario.machine.tracks);  // 1.45
  EXPECT_GT(expected, 1.3);
  EXPECT_NEAR(apparent_width(scenario), expected, 0.01 * expected);  // it starts and stops: under 1 % of 20 s
  // Coulomb: neither the floor nor the weight nor the speed matters.
  scenario.floor.friction = 0.4;
  EXPECT_NEAR(apparent_width(scenario), expected, 0.01 * expected);
  scenario.actual.mass_kg = 80.0;
  EXPECT_NEAR(apparent_width(scenario, 0.25), expected, 0.01 * expected);
  scenario.machine.tracks.contact_length_m = 1.0;
  EXPECT_NEAR(apparent_width(scenario), apparent_width_by_torque(scenario.machine.tracks), 0.015 * expected);
}

// Their traction is that of skidding pads, wherever the step ends: motors that felt it a step late would chatter.
TEST(Tracked, StrongMotorsTurnItAsFarAsIdealOnesAndWeakOnesNotAtAll) {
  Scenario scenario = andros({});
  const double expected = apparent_width_by_torque(scenario.machine.tracks);
  scenario.motor.ideal = false;
  scenario.motor.torque_limit_nm = 500.0;
  for (const double step_s : {0.004, 0.001}) {
    scenario.step_s = step_s;
    EXPECT_NEAR(apparent_width(scenario), expected, 0.015 * expected);  // what the motors lag adds to the ramps' 1 %
  }
  // To skid it takes more than 0.8 of the weight on half the tracks at their radius: 80 Nm.
  scenario.motor.torque_limit_nm = 8.0;
  scenario.path = HandPath{5.0};
  Simulation simulation(scenario, 1);
  simulation.drive_by_hand(0.0, 0.5);
  run_to_end(simulation, 5.0);
  EXPECT_LT(std::abs(simulation.state().true_pose.heading_rad), 1e-4);
}

// Of a scenario that says nothing of motors.
TEST(Tracked, TheUsualMotorsOfTracksTurnIt) {
  for (const double mass_kg : {Scenario{}.actual.mass_kg, 200.0}) {
    Scenario newcomers = andros(SquarePath{});
    newcomers.actual.mass_kg = mass_kg;
    const double ideal = apparent_width(newcomers);
    newcomers.motor = usual_motor(newcomers.vehicle.kind);
    EXPECT_NEAR(apparent_width(newcomers), ideal, 0.02 * ideal) << mass_kg;  // starting up, as with strong motors
  }
}

TEST(Tracked, AWeightForwardTurnsItAboutAPointAhead) {
  Scenario scenario = andros(HandPath{20.0});
  scenario.machine.tracks.centre_of_mass_x_m = 0.10;
  Simulation simulation(scenario, 1);
  simulation.drive_by_hand(0.0, 0.5);
  double least_x_m = 0.0, most_x_m = 0.0;
  while (!simulation.state().finished) {
    simulation.step();
    least_x_m = std::min(least_x_m, simulation.state().true_pose.x_m);
    most_x_m = std::max(most_x_m, simulation.state().true_pose.x_m);
  }
  // The middle circles round a point p ahead of it, between it and beyond the centre of mass; x runs over p (1 - cos).
  EXPECT_GT(most_x_m - least_x_m, 0.10);
  EXPECT_LT(most_x_m - least_x_m, 0.70);
}

TEST(Tracked, AJoystickBringsItHomeWhileItsOdometryIsMetresOff) {
  Scenario scenario = andros(SquarePath{2.0, false});
  scenario.driving.by_eye = true;
  Simulation simulation(scenario, 1);
  run_to_end(simulation, 600.0);
  ASSERT_TRUE(simulation.state().finished);
  EXPECT_LT(length(simulation.state().true_pose.position()), 0.02);
  const double turned = apparent_width_by_torque(scenario.machine.tracks);
  // Four corners, each seen as 90 degrees times the apparent width; ramps and the driver's corrections: 2 %.
  EXPECT_NEAR(simulation.state().estimated_pose.heading_rad, 2.0 * kPi * turned, 0.02 * 2.0 * kPi * turned);
  EXPECT_GT(length(simulation.state().estimated_pose.position()), 1.0);
}

}  // namespace
}  // namespace odolab
