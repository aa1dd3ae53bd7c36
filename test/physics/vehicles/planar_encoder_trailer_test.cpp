#include <gtest/gtest.h>

#include <cmath>

#include "physics/ground.h"
#include "physics/sensors/slip_ring.h"
#include "physics/simulation.h"
#include "test/support/finished_run.h"

namespace odolab {
namespace {

Scenario andros_with_trailer(const Path& path) {
  Scenario scenario;
  scenario.vehicle.name = "Andros with trailer";
  EncoderTrailer vehicle;
  vehicle.tow.wheel_radius_left_m = vehicle.tow.wheel_radius_right_m = 0.10;
  vehicle.tow.wheelbase_m = 0.50;
  vehicle.trailer.encoder_counts_per_revolution = 1e6;
  vehicle.hitch_angle_resolution_rad = 0.0;
  scenario.vehicle.kind = vehicle;
  scenario.actual.mass_kg = 200.0;
  scenario.actual.moment_of_inertia_kgm2 = 20.0;
  scenario.motor.ideal = true;
  scenario.driving.by_eye = true;
  scenario.path = path;
  scenario.step_s = 0.002;
  return scenario;
}

TEST(EncoderTrailer, KnowsWhereItIsThoughTheTracksSlip) {
  const Simulation simulation = finished(andros_with_trailer(SquarePath{2.0, false}));
  const Pose &truth = simulation.state().true_pose, &believed = simulation.state().estimated_pose;
  // Fine encoders: chords at the middle heading of 20 ms, 4 mm each, on curves of 0.4 m and more. Their third order
  // sums up to well below a millimetre.
  EXPECT_NEAR(believed.x_m, truth.x_m, 0.002);
  EXPECT_NEAR(believed.y_m, truth.y_m, 0.002);
  EXPECT_NEAR(believed.heading_rad, truth.heading_rad, 0.001);
}

TEST(EncoderTrailer, StaysPinnedAtItsHitch) {
  const Scenario scenario = andros_with_trailer(SquarePath{1.0, true});
  Simulation simulation(scenario, 1);
  double gap_m = 0.0;
  while (!simulation.state().finished) {
    simulation.step();
    const Pose& trailer = simulation.state().other_bodies.at(0);
    const Vec2 hitch = simulation.state().true_pose * Vec2{-EncoderTrailer{}.hitch_offset_m, 0.0};
    gap_m = std::max(gap_m, length(trailer * Vec2{EncoderTrailer{}.drawbar_length_m, 0.0} - hitch));
  }
  EXPECT_LT(gap_m, 1e-6);
}

TEST(EncoderTrailer, SwivelsAndLeadsWhenTheVehicleReverses) {
  Scenario scenario = andros_with_trailer(StraightPath{4.0, true});
  scenario.floor.friction = 0.7;
  Simulation simulation(scenario, 1);
  // A nudge on the way out: straight behind is the unstable balance of a pushed castor, and rests there without one.
  while (simulation.state().time_s < 10.0) simulation.step();
  simulation.push({0.0, 60.0});
  run_to_end(simulation, 600.0);
  const double hitch_rad =
      wrapped(simulation.state().true_pose.heading_rad - simulation.state().other_bodies.at(0).heading_rad);
  EXPECT_NEAR(std::abs(hitch_rad), kPi, 0.35);  // swivelled; it goes on settling by exp(-way / drawbar)
  // Its odometry goes on through the swivel.
  EXPECT_NEAR(simulation.state().estimated_pose.x_m, simulation.state().true_pose.x_m, 0.002);
  EXPECT_NEAR(simulation.state().estimated_pose.y_m, simulation.state().true_pose.y_m, 0.002);
}

TEST(EncoderTrailer, ABumpUnderOneOfItsWheelsTurnsItsBeliefAndNotTheVehicle) {
  Scenario scenario = andros_with_trailer(StraightPath{3.0});
  Bump cable;
  cable.centre = {1.0, 0.0};
  cable.length_m = 1.5;
  cable.under = Under::left_wheel;
  scenario.floor.bumps.push_back(cable);
  const Simulation simulation = finished(scenario);
  EXPECT_NEAR(simulation.state().true_pose.heading_rad, 0.0, 1e-3);  // tracks bridge a cable
  const double expected_rad = -extra_roll_m(EncoderTrailer{}.trailer.wheel_radius_left_m, cable.height_m) /
                              EncoderTrailer{}.trailer.wheelbase_m;
  EXPECT_NEAR(simulation.state().estimated_pose.heading_rad, expected_rad, 0.02 * std::abs(expected_rad));
}

TEST(SlipRing, AddsFalseCountsAsOftenAndAsLargeAsItSays) {
  constexpr double kBurstsPerS = 0.5, kTime_s = 100.0;
  constexpr int kLargest = 10, kRuns = 400;
  double sum = 0.0, squares = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    SlipRing ring(kBurstsPerS, kLargest, static_cast<std::uint64_t>(run));
    WheelPair counts;
    for (double t = 0.0; t <= kTime_s; t += 0.02) counts = ring.false_counts(t);
    sum += counts.left + counts.right;
    squares += counts.left * counts.left + counts.right * counts.right;
  }
  // Each burst is one of -10 to 10 with equal chances: variance n (n + 1) / 3; 50 bursts in the mean.
  const double variance = kLargest * (kLargest + 1.0) / 3.0 * kBurstsPerS * kTime_s;
  EXPECT_NEAR(squares / kRuns, variance, 0.2 * variance);  // 800 sums: 5 % (1 sigma), four times that
  EXPECT_NEAR(sum / kRuns, 0.0, 4.0 * std::sqrt(variance / kRuns));
}

}  // namespace
}  // namespace odolab
