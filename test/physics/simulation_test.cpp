#include "physics/simulation.h"

#include <gtest/gtest.h>

#include "core/odometry/differential_drive.h"
#include "physics/ground.h"

namespace odolab {
namespace {

constexpr double kRadius_m = 0.075, kBase_m = 0.340;

Scenario ideal_labmate(Path path) {
  Scenario scenario;
  scenario.path = std::move(path);
  scenario.motor.ideal = true;
  return scenario;
}

// Phases that drive a straight of this length and then turn on the spot, at constant speed between even ramps.
void add_side(WheelSpeedPath& path, double length_m, double turn_rad) {
  const double w = 0.2 / kRadius_m;
  path.phases.push_back({length_m / 0.2, w, w});
  path.phases.push_back({1.0, 0.0, 0.0});
  const double arc_m = 0.5 * kBase_m * turn_rad;
  path.phases.push_back({arc_m / 0.2, -w, w});
  path.phases.push_back({1.0, 0.0, 0.0});
}

// The largest distance between the true track and the closed form: exact straights and exact turns on the spot.
double largest_error_m(const Scenario& scenario, const std::vector<Vec2>& corners) {
  Simulation simulation(scenario, 1);
  run_to_end(simulation);
  double largest = 0.0;
  for (const TimedPose& p : simulation.true_track()) {
    double nearest = 1e9;  // distance to the polygon
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const Vec2 side = corners[i + 1] - corners[i], to = p.pose.position() - corners[i];
      const double u = std::clamp(dot(to, side) / dot(side, side), 0.0, 1.0);
      nearest = std::min(nearest, length(to - u * side));
    }
    largest = std::max(largest, nearest);
  }
  const Vec2 end = simulation.state().true_pose.position();
  return std::max(largest, length(end - corners.back()));
}

// A body with far-out masses: at the wheel's rim it is four times as heavy to turn as to push.
TEST(Simulation, WheelsOfABodyThatIsHeavyToTurnDoNotChatter) {
  WheelSpeedPath path;
  for (const double w : {3.0, -3.0, 2.0, -2.0}) path.phases.push_back({3.0, -w, w});
  Scenario scenario;
  scenario.path = path;
  const double b = scenario.actual.wheelbase_m;
  scenario.actual.moment_of_inertia_kgm2 = scenario.actual.mass_kg * b * b;
  Simulation simulation(scenario, 1);
  // A motor's torque at the rim, less than the grip: a wheel can only pull harder while it chatters.
  const double rim_n = scenario.motor.torque_limit_nm / scenario.actual.wheel_radius_left_m;
  ASSERT_LT(rim_n,
            0.5 * scenario.floor.friction * scenario.actual.drive_wheel_load_share * scenario.actual.mass_kg * 9.81);
  double largest_n = 0.0;
  while (!simulation.state().finished) {
    simulation.step();
    largest_n = std::max(largest_n, std::abs(simulation.state().left.traction_n));
  }
  EXPECT_LT(largest_n, rim_n);
  // Nothing slips, so the heading is that of the wheels; the solver works in single precision.
  const SimulationState& s = simulation.state();
  const double by_wheels_rad = (scenario.actual.wheel_radius_right_m * s.right.rotation_rad -
                                scenario.actual.wheel_radius_left_m * s.left.rotation_rad) /
                               b;
  EXPECT_NEAR(wrapped(s.true_pose.heading_rad - by_wheels_rad), 0.0, 1e-6);
}

TEST(Simulation, StaysWithinFiftyMicrometresOfTheClosedFormOverASquare) {
  for (const double away_m : {0.0, 100.0}) {
    WheelSpeedPath path;
    for (int side = 0; side < 4; ++side) add_side(path, 4.0, 0.5 * kPi);
    Scenario scenario = ideal_labmate(path);
    scenario.start = {away_m, away_m, 0.0};
    const Vec2 o = scenario.start.position();
    const double error_m = largest_error_m(scenario, {o, o + Vec2{4, 0}, o + Vec2{4, 4}, o + Vec2{0, 4}, o});
    EXPECT_LT(error_m, 0.05e-3) << "at " << away_m << " m";  // the bar
    RecordProperty(away_m == 0.0 ? "at_origin_mm" : "at_100m_mm", std::to_string(1e3 * error_m));
  }
}

TEST(Simulation, StaysWithinFiftyMicrometresOfTheClosedFormOverTwoHundredMetres) {
  for (const double away_m : {0.0, 100.0}) {
    WheelSpeedPath path;
    path.phases.push_back({200.0 / 0.5, 0.5 / kRadius_m, 0.5 / kRadius_m});
    Scenario scenario = ideal_labmate(path);
    scenario.start = {away_m, away_m, 0.7};
    const Vec2 o = scenario.start.position();
    const double error_m = largest_error_m(scenario, {o, scenario.start * Vec2{200.0, 0.0}});
    EXPECT_LT(error_m, 0.05e-3) << "at " << away_m << " m";  // the bar
    RecordProperty(away_m == 0.0 ? "at_origin_mm" : "at_100m_mm", std::to_string(1e3 * error_m));
  }
}

TEST(Simulation, TenMillimetreBumpUnderOneWheelTurnsTheLabMateByPointFiveNineDegrees) {
  for (const double step_s : {0.001, 0.005}) {
    Scenario scenario = ideal_labmate(WheelSpeedPath{{{10.0, 0.2 / kRadius_m, 0.2 / kRadius_m}}, 0.5});
    scenario.step_s = step_s;
    scenario.floor.bumps.push_back({{1.0, 0.0}, 0.5 * kPi, 2.0, 0.010, Under::left_wheel});
    Simulation simulation(scenario, 1);
    run_to_end(simulation);
    // The left wheel turns further than it travels, so the vehicle turns left by the extra way over the wheelbase.
    EXPECT_NEAR(degrees(simulation.state().true_pose.heading_rad), 0.592, 0.03 * 0.592) << "at a step of " << step_s;
    EXPECT_NEAR(extra_roll_m(kRadius_m, 0.010), 3.515e-3, 1e-6);
  }
}

TEST(Simulation, CableAcrossTheWayUnderBothWheelsOnlyShortensTheWay) {
  Scenario scenario = ideal_labmate(WheelSpeedPath{{{10.0, 0.2 / kRadius_m, 0.2 / kRadius_m}}, 0.5});
  scenario.floor.bumps.push_back({{1.0, 0.0}, 0.5 * kPi, 2.0, 0.010, Under::any_wheel});
  Simulation simulation(scenario, 1);
  run_to_end(simulation);
  EXPECT_NEAR(simulation.state().true_pose.heading_rad, 0.0, 1e-9);
  EXPECT_NEAR(simulation.state().true_pose.x_m, 2.0 - extra_roll_m(kRadius_m, 0.010), 0.03 * 3.5e-3);
}

TEST(Simulation, SlipZoneTakesItsShareOfTheRolledDistance) {
  Scenario scenario = ideal_labmate(WheelSpeedPath{{{10.0, 0.2 / kRadius_m, 0.2 / kRadius_m}}, 0.5});
  SlipZone zone;
  zone.shape = Rectangle{{1.0, 0.0}, 0.5, 2.0, 0.0};
  zone.slip = 0.1;
  scenario.floor.slip_zones.push_back(zone);
  Simulation simulation(scenario, 1);
  run_to_end(simulation);
  // Half a metre of floor needs 0.5 / 0.9 m of rolling: 0.0556 m are lost; one step's travel of 0.2 mm at each edge.
  EXPECT_NEAR(simulation.state().true_pose.x_m, 2.0 - 0.5 * (1.0 / 0.9 - 1.0), 0.2e-3);
}

TEST(Simulation, WheelsSpinOnIceAndTheEncodersGoOnCounting) {
  Scenario scenario;
  scenario.path = StraightPath{2.0, false};
  scenario.floor.friction = 0.002;  // grip for 0.0014 g: 0.0137 m/s2, far below the driver's 0.2
  Simulation simulation(scenario, 1);
  run_to_end(simulation, 60.0);
  EXPECT_GT(simulation.state().estimated_pose.x_m, 1.9);
  EXPECT_LT(simulation.state().true_pose.x_m, 1.2);
}

TEST(Simulation, PerfectRobotReturnsToItsStartByDeadReckoning) {
  Scenario scenario;
  scenario.path = SquarePath{4.0, false};
  Simulation simulation(scenario, 1);
  run_to_end(simulation);
  ASSERT_TRUE(simulation.state().finished);
  const SimulationState& end = simulation.state();
  // 2000 counts a turn: 0.24 mm a count; a fraction of a count in heading (0.35 mrad) acts over 4 m.
  EXPECT_NEAR(length(end.true_pose.position() - end.estimated_pose.position()), 0.0, 3e-3);
  EXPECT_NEAR(length(end.estimated_pose.position()), 0.0, 5e-3);  // the driver's own precision
  EXPECT_NEAR(end.estimated_pose.heading_rad, 2.0 * kPi, 2e-3);
}

TEST(Simulation, WiderActualWheelbaseTurnsTooLittleInBothDirections) {
  for (const bool clockwise : {false, true}) {
    Scenario scenario;
    scenario.path = SquarePath{4.0, clockwise};
    scenario.actual.wheelbase_m = 0.340 * 1.01;
    Simulation simulation(scenario, 1);
    run_to_end(simulation);
    const SimulationState& end = simulation.state();
    // Eq. 6.27: four turns of 90 degrees, each too small by 90 (1 - 1/1.01).
    const double missing = 2.0 * kPi * (1.0 - 1.0 / 1.01);
    EXPECT_NEAR(std::abs(end.estimated_pose.heading_rad) - std::abs(end.true_pose.heading_rad), missing, 2e-3);
  }
}

TEST(Simulation, FigureEightAndWaypointsEndWhereTheyShould) {
  Scenario eight;
  eight.path = FigureEightPath{1.0, 2};
  Simulation figure(eight, 1);
  run_to_end(figure);
  EXPECT_TRUE(figure.state().finished);
  EXPECT_NEAR(length(figure.state().estimated_pose.position()), 0.0, 0.01);
  Scenario way;
  way.path = WaypointPath{{{1.0, 0.5}, {2.0, -0.5}, {0.5, -1.0}}};
  Simulation free(way, 1);
  run_to_end(free);
  EXPECT_TRUE(free.state().finished);
  EXPECT_NEAR(length(free.state().estimated_pose.position() - Vec2{0.5, -1.0}), 0.0, 0.005);
}

TEST(Simulation, StraightThereAndBackReturnsInReverse) {
  Scenario scenario;
  scenario.path = StraightPath{3.0, true};
  Simulation simulation(scenario, 1);
  run_to_end(simulation);
  EXPECT_NEAR(simulation.state().true_pose.x_m, 0.0, 2e-3);
  EXPECT_NEAR(simulation.state().true_pose.heading_rad, 0.0, 2e-3);
}

TEST(Simulation, StandsBeforeItSetsOffAndAtTheEndOfItsWay) {
  constexpr double kStands_s = 3.0;
  WheelSpeedPath by_wheels;
  by_wheels.phases.push_back({4.0, 2.0, 2.5});
  for (const Path& path : {Path{StraightPath{1.0, true}}, Path{by_wheels}}) {
    Scenario scenario = ideal_labmate(path);
    Simulation at_once(scenario, 1);
    run_to_end(at_once);
    scenario.driving.stands_s = kStands_s;
    Simulation stands(scenario, 1);
    run_to_end(stands);
    EXPECT_NEAR(stands.state().time_s, at_once.state().time_s + 2.0 * kStands_s, 1e-9);
    const Track &way = at_once.true_track(), &late = stands.true_track();
    const auto waits = static_cast<std::size_t>(std::lround(kStands_s / scenario.sensors.encoder_period_s));
    ASSERT_GT(late.size(), way.size() + waits);
    for (std::size_t i = 0; i < late.size(); ++i) {
      const Pose& then = way[i < waits ? 0 : std::min(i - waits, way.size() - 1)].pose;
      ASSERT_LT(length(late[i].pose.position() - then.position()), 1e-5) << "at " << late[i].time_s << " s";
    }
  }
}

TEST(Simulation, SmallTiltIsHeldByTheWheelsAndALargeOneIsNot) {
  Scenario scenario;
  scenario.path = HandPath{2.0};
  scenario.floor.tilt_rad = radians(5.0);
  scenario.floor.downhill_direction_rad = 0.5 * kPi;
  Simulation held(scenario, 1);
  run_to_end(held);
  EXPECT_NEAR(held.state().true_pose.y_m, 0.0, 1e-5);
  scenario.floor.friction = 0.05;  // tan 5 degrees is 0.087, and the castors carry 30 %
  Simulation slides(scenario, 1);
  run_to_end(slides);
  const double acceleration = 9.81 * (std::sin(radians(5.0)) - 0.05 * 0.7);
  EXPECT_NEAR(slides.state().true_pose.y_m, 0.5 * acceleration * 4.0, 0.01);
}

TEST(Simulation, SameSeedGivesTheSameRecordingToTheBit) {
  Scenario scenario;
  scenario.path = FigureEightPath{0.5, 1};
  scenario.floor.roughness.largest_height_m = 0.001;
  scenario.sensors.truth_position_noise_m = 0.001;
  const auto run = [&](std::uint64_t seed) {
    Simulation simulation(scenario, seed);
    run_to_end(simulation);
    return simulation.recording();
  };
  const Recording a = run(7), b = run(7), c = run(8);
  ASSERT_EQ(a.time_s, b.time_s);
  for (std::size_t i = 0; i < a.channels.size(); ++i)
    for (std::size_t k = 0; k < a.time_s.size(); ++k)
      ASSERT_TRUE(a.channels[i].values[k] == b.channels[i].values[k] || std::isnan(a.channels[i].values[k]));
  EXPECT_NE(a.channel("truth_x_m")->values[0], c.channel("truth_x_m")->values[0]);
}

TEST(Simulation, RecordingReplayedThroughTheSameVehicleGivesTheSameTrack) {
  Scenario scenario;
  scenario.path = FigureEightPath{0.7, 1};
  scenario.actual.wheel_radius_left_m = 0.0752;
  scenario.actual.wheelbase_m = 0.345;
  Simulation driven(scenario, 3);
  run_to_end(driven);
  Scenario again = scenario;
  again.path = ReplayPath{};
  const auto recording = std::make_shared<const Recording>(driven.recording());
  Simulation replayed(again, 3, recording);
  run_to_end(replayed);
  const auto error = track_error(replayed.true_track(), driven.true_track());
  ASSERT_TRUE(error);
  // What the encoders round away: half a count (0.12 mm) on each wheel, 0.7 mrad in heading, over 9 m.
  EXPECT_LT(error->largest_position_m, 3e-3);
  EXPECT_LT(std::abs(error->end_heading_rad), 1.5e-3);
}

}  // namespace
}  // namespace odolab
