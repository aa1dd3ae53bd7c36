#include "core/calibration/first_guess.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

// A robot of wheelbase 0.2 m and radii 0.05 m on winding arcs, laid down in millisecond steps; encoders and truth at 50
// Hz.
InnovationRun winding_arcs(double radius_m, double wheelbase_m) {
  InnovationRun run;
  run.truth_has_heading = true;
  Pose pose;
  double left = 0.0, right = 0.0;
  for (int k = 0; k <= 40000; ++k) {
    const double t = 0.001 * k;
    if (k % 20 == 0) {
      run.wheels.push_back({t, left, right});
      run.truth.push_back({t, pose.position(), pose.heading_rad});
    }
    const double v = 0.3, w = 0.8 * std::sin(0.5 * t);
    left += (v - 0.5 * wheelbase_m * w) / radius_m * 0.001;
    right += (v + 0.5 * wheelbase_m * w) / radius_m * 0.001;
    pose = {pose.x_m + v * 0.001 * std::cos(pose.heading_rad), pose.y_m + v * 0.001 * std::sin(pose.heading_rad),
            pose.heading_rad + w * 0.001};
  }
  return run;
}

DifferentialDrive drive_with(double radius_m, double wheelbase_m) {
  DifferentialDrive d;
  d.wheel_radius_left_m = d.wheel_radius_right_m = radius_m;
  d.wheelbase_m = wheelbase_m;
  return d;
}

TEST(FirstGuess, FindsARobotOfHalfTheBelievedSize) {
  const FirstGuess guess = first_guess({winding_arcs(0.05, 0.2)}, drive_with(0.1, 0.4));
  ASSERT_TRUE(guess.trusted);
  // Chords instead of arcs over half a second: (0.4 rad)^2 / 24.
  EXPECT_NEAR(guess.drive.wheel_radius_left_m, 0.05, 0.0005);
  EXPECT_NEAR(guess.drive.wheelbase_m, 0.2, 0.002);
  EXPECT_EQ(contradiction_in({winding_arcs(0.05, 0.2)}, drive_with(0.1, 0.4)).found, "");
}

TEST(FirstGuess, IsNotLedAstrayByOneJumpOfACounter) {
  InnovationRun run = winding_arcs(0.05, 0.2);
  for (std::size_t i = 700; i < run.wheels.size(); ++i) run.wheels[i].left_rad += 1e6;
  const FirstGuess guess = first_guess({run}, drive_with(0.05, 0.2));
  ASSERT_TRUE(guess.trusted);
  EXPECT_NEAR(guess.drive.wheelbase_m, 0.2, 0.002);
}

TEST(FirstGuess, NamesWhatNoCalibrationMends) {
  const DifferentialDrive nominal = drive_with(0.05, 0.2);
  const auto says = [&](const InnovationRun& run, const char* words) {
    const std::string found = contradiction_in({run}, nominal).found;
    EXPECT_NE(found.find(words), std::string::npos) << words << ": " << found;
  };
  InnovationRun exchanged = winding_arcs(0.05, 0.2), reversed = exchanged, one = exchanged, degrees_run = exchanged,
                millimetres = exchanged;
  for (WheelSample& w : exchanged.wheels) std::swap(w.left_rad, w.right_rad);
  for (WheelSample& w : reversed.wheels) w = {w.time_s, -w.left_rad, -w.right_rad};
  for (WheelSample& w : one.wheels) w.left_rad = -w.left_rad;
  for (TruthSample& t : degrees_run.truth) t.heading_rad = degrees(*t.heading_rad);
  for (TruthSample& t : millimetres.truth) t.position = 1000.0 * t.position;
  says(exchanged, "exchanged");
  says(reversed, "roll backward");
  says(one, "one wheel");
  says(degrees_run, "degrees");
  says(millimetres, "other units");
}

TEST(FirstGuess, ExplainsADriveThatCrawlsMostOfTheTime) {
  InnovationRun run = winding_arcs(0.05, 0.2);
  const WheelSample wheels = run.wheels.back();
  const TruthSample truth = run.truth.back();
  Random random(6);
  for (int k = 1; k <= 4000; ++k) {  // 80 s at 0.7 mm/s under a millimetre of noise
    const double t = 0.02 * k, way_m = 0.0007 * t;
    run.wheels.push_back({wheels.time_s + t, wheels.left_rad + way_m / 0.05, wheels.right_rad + way_m / 0.05});
    const Vec2 on = rotated({way_m, 0.0}, *truth.heading_rad);
    run.truth.push_back({truth.time_s + t, truth.position + on + Vec2{0.001 * random.normal(), 0.001 * random.normal()},
                         *truth.heading_rad + 0.002 * random.normal()});
  }
  EXPECT_EQ(contradiction_in({run}, drive_with(0.05, 0.2)).found, "");
  const FirstGuess guess = first_guess({run}, drive_with(0.05, 0.2));
  ASSERT_TRUE(guess.trusted);
  EXPECT_NEAR(guess.drive.wheelbase_m, 0.2, 0.002);
}

// By least squares a place that is 30 m away for one sample outweighs all other stretches together.
TEST(FirstGuess, IsNotLedAstrayByOnePlaceFarAway) {
  for (const std::size_t at : {300u, 700u, 1000u, 1025u, 1500u}) {
    InnovationRun run = winding_arcs(0.05, 0.2);
    run.truth[at].position.x_m += 30.0;
    EXPECT_EQ(contradiction_in({run}, drive_with(0.05, 0.2)).found, "") << at;
    const FirstGuess guess = first_guess({run}, drive_with(0.05, 0.2));
    ASSERT_TRUE(guess.trusted) << at;
    EXPECT_NEAR(guess.drive.wheel_radius_left_m, 0.05, 0.0005) << at;
  }
}

// A quarter of an hour of waiting under headings that tremble is no turning: by every half-second of it the truth had
// turned 26 times as far as the wheels, as if it were in degrees.
TEST(FirstGuess, CountsNoTremorOfHeadingsWhileItWaits) {
  constexpr double kWaits_s = 900.0;
  InnovationRun run = winding_arcs(0.05, 0.2);
  for (WheelSample& w : run.wheels) w.time_s += kWaits_s;
  for (TruthSample& t : run.truth) t.time_s += kWaits_s;
  std::vector<TruthSample> waiting;
  Random random(7);
  for (double t = 0.0; t < kWaits_s; t += 0.02) waiting.push_back({t, {}, 0.1 * random.normal()});
  run.truth.insert(run.truth.begin(), waiting.begin(), waiting.end());
  run.wheels.insert(run.wheels.begin(), {0.0, 0.0, 0.0});
  EXPECT_EQ(contradiction_in({run}, drive_with(0.05, 0.2)).found, "");
}

// Whether the way tells nothing, as both go forward evenly, or a little: the turns are another's.
TEST(FirstGuess, SaysThatTheTruthIsAnotherRuns) {
  for (const double faster_mps : {0.0, 0.12}) {
    InnovationRun run = winding_arcs(0.05, 0.2), other = run;
    Pose pose;
    for (std::size_t i = 0; i < other.truth.size(); ++i) {
      const double t = other.truth[i].time_s;
      other.truth[i] = {t, pose.position(), pose.heading_rad};
      pose = advanced(pose, (0.3 + faster_mps * std::sin(0.7 * t)) * 0.02,
                      0.9 * std::cos(0.83 * t + 0.4 * std::sin(0.31 * t)) * 0.02);
    }
    const std::string said = contradiction_in({other}, drive_with(0.05, 0.2)).found;
    EXPECT_NE(said.find("another run's truth"), std::string::npos) << said;
  }
}

TEST(CounterJumps, AreNoneWhereReadingsWereLeftOut) {
  InnovationRun run = winding_arcs(0.05, 0.2);
  for (std::size_t i = 700; i < run.wheels.size(); ++i) run.wheels[i].left_rad += 1e4;
  EXPECT_EQ(counter_jumps_in({run}).size(), 1u);
  run.left_out = {{run.wheels[699].time_s, run.wheels[700].time_s}};
  EXPECT_TRUE(counter_jumps_in({run}).empty());
}

}  // namespace
}  // namespace odolab
