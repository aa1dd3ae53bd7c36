// Effects of the wheels: their radius, their direction, their slip.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test/physics/effects/effect_runs.h"

namespace odolab {
namespace {

// A step of 1 ms in which a changing tread drags 50 kg along leaves micrometres; radii and angles are exact.
constexpr double kExact_m = 2e-5, kExact_rad = 1e-4;

TEST(WheelEccentricity, SwingsTheHeadingOnceATurnByRadiusTimesAmplitudeOverWheelbase) {
  const double amplitude = 0.006;
  Scenario scenario = table_drive({phase(10.0, 0.2, 0.0)}, {{"wheel_eccentricity", "left_wheel", {{"amplitude", amplitude}, {"phase_rad", 0.4}}}});
  Simulation simulation(scenario, 1);
  double largest_rad = 0.0;
  while (!simulation.state().finished) {
    simulation.step();
    // The left wheel has rolled r a (cos(phase) - cos(phi + phase)) too far: the vehicle turns right by that over b.
    const double phi = simulation.state().left.rotation_rad;
    const double expected_rad = -kRadius_m * amplitude * (std::cos(0.4) - std::cos(phi + 0.4)) / kBase_m;
    largest_rad = std::max(largest_rad, std::abs(simulation.state().true_pose.heading_rad - expected_rad));
  }
  EXPECT_LT(largest_rad, 0.01 * kRadius_m * amplitude / kBase_m);  // a hundredth of the swing
}

TEST(RadiusDrift, RollsFurtherByHalfTheDriftTimesTheSquareOfTime) {
  const Pose end = end_pose(table_drive({phase(20.0, 0.2, 0.0)}, {{"radius_drift", "both_wheels", {{"per_s", 1e-3}}}}));
  // Distance without drift 4 m; 0.2 per_s (T^2/2) more, and the ramps make the mean time 10.25 s.
  EXPECT_NEAR(end.x_m, 4.0 + 4.0 * 1e-3 * 10.25, kExact_m);
  EXPECT_NEAR(end.heading_rad, 0.0, kExact_rad);
}

// Newton's law: what is left to warm falls by the same share in the same time. At 0.2 m/s for 20 s with ramps of 0.5 s.
TEST(RadiusDrift, ThatNearsAnEndGrowsByTheIntegralOfItsExponential) {
  const Pose end = end_pose(table_drive({phase(20.0, 0.2, 0.0)},
                                        {{"radius_drift", "both_wheels", {{"per_s", 1e-3}, {"time_constant_s", 8.0}}}}));
  double further_m = 0.0;
  for (double t = 0.0005; t < 20.5; t += 0.001)
    further_m += 0.001 * std::min({0.4 * t, 0.2, 0.4 * (20.5 - t)}) * 1e-3 * 8.0 * (1.0 - std::exp(-t / 8.0));
  EXPECT_NEAR(end.x_m, 4.0 + further_m, kExact_m);
}

TEST(SpeedDependentRadius, ChangesTheWayByItsShareAtEachSpeed) {
  const auto way_m = [](double speed_mps) {
    return end_pose(table_drive({phase(10.0, speed_mps, 0.0)}, {{"speed_dependent_radius", "both_wheels", {{"per_mps", 0.02}}}})).x_m;
  };
  // The integral of v (1 + k v): at full speed for 9.5 s, and the two ramps of 0.5 s give v^2 / 3 each.
  for (const double v : {0.2, 0.4}) EXPECT_NEAR(way_m(v), 10.0 * v + 0.02 * v * v * (9.5 + 2.0 * 0.5 / 3.0), kExact_m);
}

TEST(PayloadRadiusChange, StepsEachRadiusAtItsTime) {
  const Pose end = end_pose(table_drive({phase(10.0, 0.2, 0.0)}, {{"payload_radius_change", "vehicle", {{"left", -0.01}, {"right", -0.02}, {"at_s", 5.0}}}}));
  // From 5 s on a wheel rolls (10 - 5 + 0.25) s at 0.2 m/s: 1.05 m, less 1 and 2 %. A step of the radius is one of 2 to 4 mm/s.
  EXPECT_NEAR(end.heading_rad, -0.01 * 1.05 / kBase_m, kExact_rad);
}

TEST(TyreCompression, TurnsTighterOrWiderByTheSqueezedOuterTyre) {
  // 0.4 m/s at 0.8 rad/s: 0.32 m/s2 squeeze the right tyre by 0.32 mm, 0.43 % of what it rolls.
  const auto turned_rad = [](std::vector<ActiveEffect> effects) { return end_pose(table_drive({phase(20.0, 0.4, 0.8)}, std::move(effects))).heading_rad; };
  const double lost_rad = turned_rad({}) - turned_rad({{"tyre_compression", "vehicle", {{"radius_change_m_per_mps2", 1e-3}}}});
  const double outer_mps = 0.4 + 0.5 * kBase_m * 0.8;
  const double expected_rad = 1e-3 * 0.32 / kRadius_m * outer_mps / kBase_m * 19.5;
  EXPECT_NEAR(lost_rad, expected_rad, 0.04 * expected_rad);  // the turn slows by 0.8 % itself; ramps add a half of 2 %
}

TEST(WheelToe, CrawlsSidewaysInEachMetreAndBackInReverse) {
  const ActiveEffect toe{"wheel_toe", "both_wheels", {{"sideways_per_metre", 0.01}}};
  const Pose out = end_pose(table_drive({phase(10.0, 0.2, 0.0)}, {toe}));
  EXPECT_NEAR(out.y_m, 0.02, 0.02 * 1e-4 + kExact_m);  // the wheels roll at an angle: 2 m times its sine, a second-order less
  EXPECT_NEAR(out.heading_rad, 0.0, kExact_rad);
  const Pose back = end_pose(table_drive({phase(10.0, 0.2, 0.0), phase(10.0, -0.2, 0.0)}, {toe}));
  EXPECT_NEAR(back.y_m, 0.0, 0.01 * 0.1);  // the ramp between both takes 0.1 m from the way back
}

TEST(TractionSlip, LosesHalfTheCoefficientTimesTheSquareOfTheSpeedAndGetsItBackInBraking) {
  const ActiveEffect slip{"traction_slip", "both_wheels", {{"per_mps2", 0.05}}};
  const Scenario scenario = table_drive({phase(5.0, 0.4, 0.0)}, {slip});
  Simulation simulation(scenario, 1);
  while (simulation.state().time_s < 3.0) simulation.step();
  const double rolled_m = kRadius_m * simulation.state().left.rotation_rad;
  EXPECT_NEAR(rolled_m - simulation.state().true_pose.x_m, 0.5 * 0.05 * 0.4 * 0.4, 4e-5);  // 4 mm to a hundredth
  run_to_end(simulation);
  // What is left: the slip that had not yet decayed at the very end, 30 ms of a speed near zero.
  EXPECT_NEAR(simulation.state().true_pose.x_m, 2.0, 1e-4);
}

TEST(TractionSlip, LosesWayInReverseToo) {
  Simulation simulation(table_drive({phase(5.0, -0.4, 0.0)}, {{"traction_slip", "both_wheels", {{"per_mps2", 0.05}}}}), 1);
  while (simulation.state().time_s < 3.0) simulation.step();
  EXPECT_NEAR(simulation.state().true_pose.x_m - kRadius_m * simulation.state().left.rotation_rad, 0.5 * 0.05 * 0.4 * 0.4, 4e-5);
}

// With real motors at 0.9 m/s: by 0.074 per m/s2 the slip of a wheel that speeds up alone would grow as fast as its speed.
TEST(TractionSlip, OfAFastAndSlipperyVehicleLetsNoWheelRunAway) {
  const double per_mps2 = 0.074;
  Scenario scenario = table_drive({phase(6.0, 0.9, 0.0)}, {{"traction_slip", "both_wheels", {{"per_mps2", per_mps2}}}});
  scenario.motor = {.ideal = false, .wheel_inertia_kgm2 = 0.02, .torque_limit_nm = 8.0, .proportional_gain = 4.0, .integral_gain = 40.0};
  Simulation simulation(scenario, 1);
  double fastest_mps = 0.0;
  while (simulation.state().time_s < 4.0) {
    simulation.step();
    fastest_mps = std::max(fastest_mps, kRadius_m * simulation.state().left.speed_radps);
  }
  const double slipped_m = kRadius_m * simulation.state().left.rotation_rad - simulation.state().true_pose.x_m;
  EXPECT_NEAR(slipped_m, 0.5 * per_mps2 * 0.9 * 0.9, 0.02 * 0.5 * per_mps2 * 0.9 * 0.9);
  EXPECT_LT(fastest_mps, 1.3 * 0.9);  // the motors' loop alone overshoots by a quarter at most
}

TEST(TractionSlip, OfNoFormLetsAWheelWithARealMotorRunAway) {
  const double per_mps2 = 0.074;
  for (double form = 0.0; form < 10.0; ++form) {
    Scenario scenario = table_drive({phase(6.0, 0.9, 0.0)},
                                    {{"traction_slip", "both_wheels", {{"per_mps2", per_mps2}, {"form", form}}}});
    scenario.motor = {.ideal = false,
                      .wheel_inertia_kgm2 = 0.02,
                      .torque_limit_nm = 8.0,
                      .proportional_gain = 4.0,
                      .integral_gain = 40.0};
    Simulation s(scenario, 1);
    double fastest_mps = 0.0;
    while (s.state().time_s < 4.0) {
      s.step();
      fastest_mps = std::max(fastest_mps, kRadius_m * s.state().left.speed_radps);
    }
    const double slipped_m = kRadius_m * s.state().left.rotation_rad - s.state().true_pose.x_m;
    EXPECT_NEAR(slipped_m, 0.5 * per_mps2 * 0.9 * 0.9, 0.02 * 0.5 * per_mps2 * 0.9 * 0.9) << form;
    EXPECT_LT(fastest_mps, 1.3 * 0.9) << form;
  }
}

TEST(TractionSlip, ByWhatIsPushedLosesItsShareOfATurn) {
  const double k = 0.05, u = 0.5 * kBase_m * 2.0;  // a rim's speed at 2 rad/s on the spot
  const auto lost_rad = [&](double form) {
    Simulation s(
        table_drive({phase(5.0, 0.0, 2.0)}, {{"traction_slip", "both_wheels", {{"per_mps2", k}, {"form", form}}}}), 1);
    while (s.state().time_s < 3.0) s.step();
    return kRadius_m * (s.state().right.rotation_rad - s.state().left.rotation_rad) / kBase_m -
           s.state().true_pose.heading_rad;
  };
  // Each wheel loses k u^2 / 2 of its way by its own acceleration, a mast's none, a long body's 0.6 of it.
  const double own_rad = k * u * u / kBase_m;
  EXPECT_NEAR(lost_rad(0.0), own_rad, 0.01 * own_rad);
  EXPECT_NEAR(lost_rad(1.0), 0.0, 0.01 * own_rad);
  EXPECT_NEAR(lost_rad(2.0), 0.6 * own_rad, 0.01 * own_rad);
  for (const double form : {3.0, 4.0, 5.0, 6.0}) EXPECT_NEAR(lost_rad(form), own_rad, 0.01 * own_rad) << form;
}

TEST(SpeedDependentRadius, ByTheVehiclesSpeedLeavesATurnOnTheSpotAlone) {
  const auto turned_rad = [](double form) {
    return end_pose(table_drive({phase(5.0, 0.0, 2.0)},
                                {{"speed_dependent_radius", "both_wheels", {{"per_mps", 0.1}, {"form", form}}}}))
        .heading_rad;
  };
  EXPECT_NEAR(turned_rad(1.0), 10.0, 1e-3);
  EXPECT_GT(turned_rad(0.0), 10.1);
  EXPECT_NEAR(end_pose(table_drive({phase(10.0, 0.3, 0.0)},
                                   {{"speed_dependent_radius", "both_wheels", {{"per_mps", 0.1}, {"form", 1.0}}}}))
                  .x_m,
              3.0 * 1.03, 0.003);  // the ramps go slower
}

TEST(TyreCompression, OfBothTyresTurnsWiderByBoth) {
  const auto turned_rad = [](std::vector<ActiveEffect> effects) {
    return end_pose(table_drive({phase(20.0, 0.4, 0.8)}, std::move(effects))).heading_rad;
  };
  const double lost_rad =
      turned_rad({}) -
      turned_rad({{"tyre_compression", "vehicle", {{"radius_change_m_per_mps2", 1e-3}, {"form", 1.0}}}});
  const double both_mps = 2.0 * 0.4;  // of the outer rim and the inner one
  const double expected_rad = 1e-3 * 0.32 / kRadius_m * both_mps / kBase_m * 19.5;
  EXPECT_NEAR(lost_rad, expected_rad, 0.04 * expected_rad);  // as of the outer one alone
}

TEST(DrivetrainBacklash, BeginsMidwayOrIsCrossedOverALongerTurnInItsForms) {
  const auto ahead_rad = [](double form, double turned_rad) {
    Simulation s(table_drive({phase(5.0, -0.2, 0.0)},
                             {{"drivetrain_backlash", "both_wheels", {{"gap_rad", 0.05}, {"form", form}}}}),
                 1);
    while (s.state().left.counted_rad > -turned_rad) s.step();
    return s.state().left.rotation_rad - s.state().left.counted_rad;
  };
  EXPECT_NEAR(ahead_rad(0.0, 1.0), 0.0, 1e-9);  // engaged in the direction in which it sets off
  EXPECT_NEAR(ahead_rad(1.0, 1.0), 0.025, 1e-9);
  Simulation s(table_drive({phase(2.0, 0.2, 0.0), phase(5.0, -0.2, 0.0)},
                           {{"drivetrain_backlash", "both_wheels", {{"gap_rad", 0.05}, {"form", 10.0}}}}),
               1);
  double furthest_rad = 0.0;
  while (s.state().left.counted_rad > furthest_rad - 0.06 || s.state().time_s < 2.0) {
    s.step();
    furthest_rad = std::max(furthest_rad, s.state().left.counted_rad);
  }
  EXPECT_NEAR(s.state().left.rotation_rad - s.state().left.counted_rad, 0.025,
              2e-3);  // half of the 0.12 rad; a step turns 2.7 mrad
}

TEST(DrivetrainBacklash, WheelsLagByTheGapAfterAReversalWhileTheEncoderTurns) {
  const Simulation s = finished(table_drive({phase(5.0, 0.2, 0.0), phase(5.5, -0.2, 0.0)}, {{"drivetrain_backlash", "both_wheels", {{"gap_rad", 0.05}}}}));
  // Forward 5 s and back 5.5 s with ramps: the motor is where it was, the wheel a gap ahead of it.
  EXPECT_NEAR(s.state().left.counted_rad, (5.0 - 5.5) * 0.2 / kRadius_m, 1e-9);
  EXPECT_NEAR(s.state().left.rotation_rad - s.state().left.counted_rad, 0.05, 1e-9);
  // At the end of the gap the motor pulls at 77 mm/s: the wheels skid for 0.64 mm (grip 5.5 m/s2, less the ramp's 0.8).
  EXPECT_NEAR(s.state().true_pose.x_m, kRadius_m * s.state().left.rotation_rad, 7e-4);
}

TEST(DrivetrainBacklash, AWheelThatRunsEasilyRunsAheadByTheGapWhileItsMotorBrakes) {
  const auto ahead_rad = [](double drag_mps2) {
    Simulation s(table_drive({phase(5.0, 0.4, 0.0)}, {{"drivetrain_backlash", "both_wheels", {{"gap_rad", 0.05}, {"drag_mps2", drag_mps2}}}}), 1);
    run_to_end(s);
    return s.state().left.rotation_rad - s.state().left.counted_rad;
  };
  EXPECT_NEAR(ahead_rad(0.1), 0.05, 1e-9);  // the ramp brakes at 0.8 m/s2: the other flank holds the wheel back
  EXPECT_NEAR(ahead_rad(1.0), 0.0, 1e-9);   // braked harder by its own drag, it never leaves the flank that drives it
}

// Nothing that the floor does to a wheel between its flanks reaches its motor: else both bounced from flank to flank at
// 80 Hz, skidding, and the vehicle turned by 24 mrad/s.
TEST(DrivetrainBacklash, TurnsAVehicleWithRealMotorsByNoMoreThanTheGapAndItsSkid) {
  const double gap_rad = 0.0029;
  const auto heading_rad = [](std::vector<ActiveEffect> effects) {
    Scenario s = table_drive({phase(10.0, 0.54, 0.0), phase(5.0, 0.0, 1.4), phase(10.0, 0.54, 0.0)}, std::move(effects));
    s.actual.mass_kg = 30.0;
    s.actual.moment_of_inertia_kgm2 = 1.34;
    s.motor = {.ideal = false, .wheel_inertia_kgm2 = 0.02, .torque_limit_nm = 8.0, .proportional_gain = 4.0, .integral_gain = 40.0};
    s.floor.roughness.largest_height_m = 2.5e-4;
    const Simulation end = finished(s);
    return end.state().true_pose.heading_rad;
  };
  const double turned_rad = heading_rad({{"drivetrain_backlash", "right_wheel", {{"gap_rad", gap_rad}, {"drag_mps2", 0.37}}}});
  // Four times the gap, at whose end a motor of 8 N m and 0.02 kg m2 may be 0.11 m/s too fast: as long a skid as a grip
  // of 5.5 m/s2 allows.
  const double too_fast_mps = std::sqrt(2.0 * 8.0 / 0.02 * gap_rad) * kRadius_m;
  EXPECT_NEAR(turned_rad, heading_rad({}), 4.0 * (gap_rad * kRadius_m + 0.5 * too_fast_mps * too_fast_mps / 5.5) / kBase_m);
}

TEST(EncoderMissedCounts, LosesItsShareAboveTheSpeedAlone) {
  const ActiveEffect missed{"encoder_missed_counts", "left_wheel", {{"fraction", 0.02}, {"above_radps", 4.0}}};
  const Simulation slow = finished(table_drive({phase(10.0, 0.2, 0.0)}, {missed}));  // 2.7 rad/s
  EXPECT_DOUBLE_EQ(slow.state().left.counted_rad, slow.state().left.rotation_rad);
  const Simulation fast = finished(table_drive({phase(10.0, 0.6, 0.0)}, {missed}));  // 8 rad/s, above 4 for all but half of each ramp
  EXPECT_NEAR(fast.state().left.rotation_rad, 80.0, 1e-6);
  EXPECT_NEAR(80.0 - fast.state().left.counted_rad, 0.02 * (80.0 - 2.0 * 0.25 * 2.0), 0.02 * 8.0 * 2e-3);  // two steps
  EXPECT_NEAR(fast.state().true_pose.heading_rad, 0.0, kExact_rad);  // the wheel itself rolls truly
}

}  // namespace
}  // namespace odolab
