// Effects that move the whole vehicle over the floor.
#include <gtest/gtest.h>

#include "test/physics/effects/effect_runs.h"

namespace odolab {
namespace {

TEST(TurnScrub, TurnsAsIfTheWheelbaseGrewWithTheTurnRate) {
  const double k = 0.03;
  const auto turned_rad = [&](double seconds) {
    return end_pose(table_drive({phase(seconds, 0.0, 1.0)}, {{"turn_scrub", "vehicle", {{"per_radps", k}}}})).heading_rad;
  };
  // omega (1 + k omega) = 1 rad/s. The difference of two runs has no ramps in it.
  const double omega = (std::sqrt(1.0 + 4.0 * k) - 1.0) / (2.0 * k);
  EXPECT_NEAR(turned_rad(12.0) - turned_rad(2.0), 10.0 * omega, 1e-4);
}

TEST(LateralSlip, CreepsOutwardByTheCoefficientTimesTheLateralAcceleration) {
  Simulation s(table_drive({phase(10.0, 0.4, 0.5)}, {{"lateral_slip", "vehicle", {{"m_per_s_per_mps2", 0.02}}}}), 1);
  while (s.state().time_s < 5.0) s.step();
  const Pose before = s.state().true_pose;
  s.step();
  const Pose after = s.state().true_pose;
  const double middle_rad = 0.5 * (before.heading_rad + after.heading_rad);
  const Vec2 moved = rotated(after.position() - before.position(), -middle_rad);
  EXPECT_NEAR(moved.y_m / 1e-3, -0.02 * 0.4 * 0.5, 4e-5);  // to the right in a left turn: 4 mm/s, to a hundredth
}

TEST(OneSidedDrag, KeepsItsSideInReverse) {
  const ActiveEffect drag{"one_sided_drag", "vehicle", {{"rad_per_m", 0.02}}};
  for (const double speed : {0.2, -0.2})
    EXPECT_NEAR(end_pose(table_drive({phase(10.0, speed, 0.0)}, {drag})).heading_rad, 0.02 * 2.0, 1e-5);
}

TEST(CastorReversalKick, GivesItsWholeKickWithinAFewCentimetresOfEachReversal) {
  const ActiveEffect kick{"castor_reversal_kick", "vehicle", {{"kick_rad", 0.03}}};
  EXPECT_NEAR(end_pose(table_drive({phase(5.0, 0.2, 0.0)}, {kick})).heading_rad, 0.0, 1e-6);
  const Scenario there_and_back = table_drive({phase(5.0, 0.2, 0.0), phase(5.0, -0.2, 0.0)}, {kick});
  EXPECT_NEAR(end_pose(there_and_back).heading_rad, 0.03, 1e-5);
  Simulation s(there_and_back, 1);
  while (s.state().time_s < 5.5) s.step();  // it reverses at 5.25 s and is 2.5 cm back now: amid the 5 cm of the kick
  EXPECT_GT(s.state().true_pose.heading_rad, 0.003);
  EXPECT_LT(s.state().true_pose.heading_rad, 0.027);
}

TEST(CastorReversalKick, OfAFormToTwoSidesTakesBackInReverseWhatItGaveForwards) {
  const auto turned_rad = [](std::vector<WheelSpeeds> phases, double form) {
    return end_pose(table_drive(std::move(phases),
                                {{"castor_reversal_kick", "vehicle", {{"kick_rad", 0.03}, {"form", form}}}}))
        .heading_rad;
  };
  const std::vector<WheelSpeeds> back = {phase(5.0, 0.2, 0.0), phase(5.0, -0.2, 0.0)};
  std::vector<WheelSpeeds> and_forth = back;
  and_forth.push_back(phase(5.0, 0.2, 0.0));
  // A metre behind each reversal all is over, also what fades: exp(-1 / 0.07).
  for (const double form : {0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 13.0, 15.0}) {
    EXPECT_NEAR(turned_rad(back, form), 0.03, 1e-4) << form;
    EXPECT_NEAR(turned_rad(and_forth, form), 0.06, 2e-4) << form;
    EXPECT_NEAR(turned_rad(back, form + 1.0), -0.03, 1e-4) << form;
    EXPECT_NEAR(turned_rad(and_forth, form + 1.0), 0.0, 2e-4) << form;
  }
  EXPECT_NEAR(turned_rad(and_forth, 12.0), 0.06, 2e-4);
}

TEST(CastorReversalKick, ThatFadesGivesTheShareOfItsExponential) {
  Simulation s(table_drive({phase(5.0, 0.2, 0.0), phase(5.0, -0.2, 0.0)},
                           {{"castor_reversal_kick", "vehicle", {{"kick_rad", 0.03}, {"form", 13.0}}}}),
               1);
  while (s.state().time_s < 5.25) s.step();  // ramps from 0.2 to -0.2 m/s within half a second
  const double turned_back_at_m = kRadius_m * s.state().left.rotation_rad;
  while (turned_back_at_m - kRadius_m * s.state().left.rotation_rad < 0.07) s.step();
  EXPECT_NEAR(s.state().true_pose.heading_rad, 0.03 * (1.0 - std::exp(-1.0)), 0.03 * 0.003);  // steps of 0.2 mm
}

TEST(TurnScrub, ByTheWheelsIsAShareOfTheRateThatTheyRoll) {
  const double k = 0.03;
  const auto turned_rad = [&](double seconds) {
    return end_pose(
               table_drive({phase(seconds, 0.0, 1.0)}, {{"turn_scrub", "vehicle", {{"per_radps", k}, {"form", 1.0}}}}))
        .heading_rad;
  };
  EXPECT_NEAR(turned_rad(12.0) - turned_rad(2.0), 10.0 / (1.0 + k), 1e-4);
}

TEST(LateralSlip, AtAnAngleGrowsWithTheSpeedAndIsStatedAtOne) {
  // In a circle of 0.8 m radius at 0.4 m/s; a slip angle that at 0.2 m/s would be as large as the creep of 0.02 s.
  Simulation s(table_drive({phase(10.0, 0.4, 0.5)},
                           {{"lateral_slip", "vehicle", {{"m_per_s_per_mps2", 0.02}, {"at_mps", 0.2}, {"form", 1.0}}}}),
               1);
  while (s.state().time_s < 5.0) s.step();
  const Pose before = s.state().true_pose;
  s.step();
  const Pose after = s.state().true_pose;
  const Vec2 moved = rotated(after.position() - before.position(), -0.5 * (before.heading_rad + after.heading_rad));
  EXPECT_NEAR(moved.y_m / 1e-3, -0.02 * 0.4 * 0.5 * 0.4 / 0.2, 8e-5);  // 8 mm/s, to a hundredth
}

TEST(FloorSlopeCreep, WhileAWheelTurnsLeavesAVehicleAtRestWhereItIs) {
  const auto moved_m = [](double form) {
    return end_pose(table_drive({phase(10.0, 0.0, 0.0)},
                                {{"floor_slope_creep", "floor", {{"creep_mps", 0.003}, {"form", form}}}}))
        .x_m;
  };
  EXPECT_NEAR(moved_m(0.0), 0.03, 2e-3);
  EXPECT_NEAR(moved_m(1.0), 0.0, 1e-9);
}

TEST(BumpEffect, OfATimeTakesItsExtraDistanceWhereverTheWheelIs) {
  for (const double form : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
    const ActiveEffect bump{"bump", "left_wheel", {{"extra_distance_m", 0.003}, {"at_s", 5.0}, {"form", form}}};
    Simulation s(table_drive({phase(10.0, 0.2, 0.0)}, {bump}), 1);
    while (s.state().time_s < 4.0) s.step();
    EXPECT_NEAR(s.state().true_pose.heading_rad, 0.0, 1e-6) << form;
    while (s.state().time_s < 5.0) s.step();  // half of it is rolled at its time
    EXPECT_NEAR(s.state().true_pose.heading_rad, 0.5 * 0.003 / kBase_m, 0.1 * 0.003 / kBase_m) << form;
    while (s.state().time_s < 7.0) s.step();
    EXPECT_NEAR(s.state().true_pose.heading_rad, 0.003 / kBase_m, 0.01 * 0.003 / kBase_m) << form;
  }
}

TEST(SlipZoneEffect, UnderTheMiddleTakesItsShareOfBothWheelsOrOfTheWayAlone) {
  const auto end = [](double form) {
    const ActiveEffect zone{
        "slip_zone", "floor", {{"slip", 0.1}, {"x_m", 1.0}, {"y_m", 0.0}, {"radius_m", 0.3}, {"form", form}}};
    return end_pose(table_drive({phase(10.0, 0.2, 0.0)}, {zone}));
  };
  // Over 0.6 m of floor, of which 0.9 is rolled by 1: the wheels roll 0.6 / 0.9 there.
  for (const double form : {1.0, 2.0}) EXPECT_NEAR(end(form).x_m, 2.0 - 0.6 * (1.0 / 0.9 - 1.0), 1e-3) << form;
  // Turning on the spot it takes of the turn, or nothing.
  const auto turned_rad = [](double form) {
    const ActiveEffect zone{
        "slip_zone", "floor", {{"slip", 0.1}, {"x_m", 0.0}, {"y_m", 0.0}, {"radius_m", 0.1}, {"form", form}}};
    return end_pose(table_drive({phase(5.0, 0.0, 1.0)}, {zone})).heading_rad;
  };
  EXPECT_NEAR(turned_rad(1.0), 0.9 * turned_rad(2.0), 1e-3);
  EXPECT_NEAR(turned_rad(2.0), 5.0, 1e-3);
}

TEST(TurnSpeedLoss, TakesAShareOfTheSpeedInTurnsAlone) {
  const ActiveEffect loss{"turn_speed_loss", "vehicle", {{"per_radps", 0.05}}};
  EXPECT_NEAR(end_pose(table_drive({phase(10.0, 0.2, 0.0)}, {loss})).x_m, 2.0, 1e-5);
  // A steady arc: speed over turn rate is its radius, here 5 % x 0.8 smaller than 0.5 m.
  Simulation s(table_drive({phase(20.0, 0.4, 0.8)}, {loss}), 1);
  while (s.state().time_s < 5.0) s.step();
  EXPECT_NEAR(s.state().true_speed_mps, 0.4 * (1.0 - 0.05 * 0.8), 1e-5);
  EXPECT_NEAR(s.state().true_yaw_rate_radps, 0.8, 1e-5);
}

TEST(FloorSlopeCreep, MovesInOneDirectionOfTheRoomWhateverTheHeading) {
  const ActiveEffect creep{"floor_slope_creep", "floor", {{"direction_rad", 2.0}, {"creep_mps", 0.003}}};
  const std::vector<WheelSpeeds> phases = {phase(10.0, 0.2, 0.3), phase(10.0, -0.1, 0.8)};
  const Pose with = end_pose(table_drive(phases, {creep})), without = end_pose(table_drive(phases, {}));
  const Vec2 expected = rotated({0.003 * 20.5, 0.0}, 2.0);
  EXPECT_NEAR(length(with.position() - without.position() - expected), 0.0, 3e-5);  // of 61.5 mm
  EXPECT_NEAR(with.heading_rad, without.heading_rad, 1e-5);
}

TEST(Collision, TakesTheVehicleAsideByWhatItSays) {
  const ActiveEffect push{"collision", "vehicle", {{"dx_m", -0.04}, {"dy_m", 0.06}, {"dheading_rad", 0.2}, {"at_s", 2.0}}};
  for (const double speed : {0.0, 0.2}) {  // within a quarter of a second about two
    std::vector<WheelSpeeds> phases = {phase(3.0, speed, 0.0)};
    Scenario scenario = table_drive(phases, {push});
    scenario.start.heading_rad = 1.0;
    Simulation s(scenario, 1);
    while (s.state().time_s < 1.875 - 1e-9) s.step();
    const Pose before = s.state().true_pose;
    while (s.state().time_s < 2.125 - 1e-9) s.step();
    const Pose after = s.state().true_pose;
    // What the wheels roll meanwhile, 5 cm, turns along with the vehicle: by half the turn on average. The variance of the
    // heading on the way, 0.2^2 / 8, makes that way 0.25 % shorter, 0.12 mm.
    const Vec2 rolled = rotated({0.25 * speed, 0.0}, before.heading_rad + 0.1);
    EXPECT_NEAR(length(after.position() - before.position() - rolled - Vec2{-0.04, 0.06}), 0.0, speed == 0.0 ? 1e-5 : 1.5e-4);
    EXPECT_NEAR(after.heading_rad - before.heading_rad, 0.2, 1e-4);
  }
}

TEST(BumpEffect, LosesItsExtraDistanceFromWhateverSideItIsMet) {
  const double extra_m = 0.003;
  for (const double heading : {0.0, 0.7, 1.5}) {
    Scenario scenario = table_drive({phase(10.0, 0.2, 0.0)}, {});
    scenario.start.heading_rad = heading;
    const Vec2 place = scenario.start * Vec2{1.0, 0.5 * kBase_m};
    scenario.effects = {{"bump", "left_wheel", {{"extra_distance_m", extra_m}, {"x_m", place.x_m}, {"y_m", place.y_m}}}};
    EXPECT_NEAR(end_pose(scenario).heading_rad - heading, extra_m / kBase_m, 0.02 * extra_m / kBase_m);  // steps of 0.2 mm over it
  }
}

TEST(SlipZoneEffect, TakesItsShareWithinTheDisc) {
  Scenario scenario = table_drive({phase(10.0, 0.2, 0.0)}, {{"slip_zone", "floor", {{"slip", 0.1}, {"x_m", 1.0}, {"y_m", 0.0}, {"radius_m", 0.5}}}});
  // Each wheel crosses a chord of the disc 0.17 m off its middle and rolls a ninth more for it.
  const double chord_m = 2.0 * std::sqrt(0.25 - 0.17 * 0.17);
  EXPECT_NEAR(end_pose(scenario).x_m, 2.0 - chord_m * (1.0 / 0.9 - 1.0), 4e-4);  // a step of 0.2 mm at each edge
}

TEST(ActuatorDelay, FollowsTheCommandLater) {
  Scenario scenario = table_drive({phase(5.0, 0.2, 0.0)}, {{"actuator_delay", "vehicle", {{"delay_s", 0.1234}}}});
  Simulation s(scenario, 1);
  while (s.state().time_s < 3.0 - 1e-9) s.step();
  EXPECT_NEAR(s.state().true_pose.x_m, 0.2 * (3.0 - 0.25 - 0.1234), 1e-5);
}

TEST(ActuatorLag, StaysBehindByItsTimeConstant) {
  Scenario scenario = table_drive({phase(5.0, 0.2, 0.0)}, {{"actuator_lag", "vehicle", {{"time_constant_s", 0.15}}}});
  Simulation s(scenario, 1);
  while (s.state().time_s < 3.0 - 1e-9) s.step();
  // A first-order lag of a ramp that has long settled: behind by the time constant, half a step of 1 ms unsure.
  EXPECT_NEAR(s.state().true_pose.x_m, 0.2 * (3.0 - 0.25 - 0.15), 0.2 * 6e-4);
}

}  // namespace
}  // namespace odolab
