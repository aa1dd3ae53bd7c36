#include "core/diagnosis/generic/waves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/naming/own_noise.h"
#include "core/diagnosis/quality/quality.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

JointModel calibrated(const test::Case& c) {
  std::vector<InnovationRun> runs;
  for (const Recording& r : c.recordings) runs.push_back(*innovation_run(r, c.nominal));
  const LeastSquaresCalibration start = *calibrate_least_squares(c.recordings, c.nominal);
  JointModel joint(std::move(runs), std::vector<char>(c.recordings.size(), 0), start, c.nominal);
  joint.linearise();
  joint.fit(3);
  joint.fit_noise();
  joint.fit(2);
  return joint;
}

test::Case short_case(const std::string& effect) {
  test::CaseSettings settings;
  settings.effect = effect;
  settings.size = 3.0;
  settings.runs = 2;
  settings.duration_s = 40.0;
  return test::generated_case(settings, 11);
}

const GenericTest& strongest(const std::vector<GenericTest>& tests) {
  return *std::max_element(tests.begin(), tests.end(), [](const GenericTest& a, const GenericTest& b) {
    return a.test.statistic < b.test.statistic;
  });
}

TEST(LinearisedRun, ScoreOfMotionsIsTheProductWithTheColumnOfAnyMotion) {
  const JointModel joint = calibrated(short_case(""));
  const LinearisedRun& run = joint.linearised()[1];
  const std::size_t steps = run.run().wheels.size() - 1;
  Motions motions(steps);
  Random random(5);
  for (std::size_t i = 0; i < steps; ++i)
    motions[i] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
  std::vector<double> column(3 * static_cast<std::size_t>(run.samples()));
  const Stretch touched = run.of_motion(motions, column.data());
  double by_column = 0.0, by_score = 0.0, size = 0.0;
  for (std::size_t k = 3 * static_cast<std::size_t>(touched.first); k < 3 * static_cast<std::size_t>(touched.last);
       ++k) {
    by_column += column[k] * run.residual()[k];
    size += std::abs(column[k] * run.residual()[k]);
  }
  const std::vector<BodyMotion> score = run.score_of_motions(run.residual().data());
  for (std::size_t i = 0; i < steps; ++i)
    by_score += score[i].forward_m * motions[i].forward_m + score[i].sideways_m * motions[i].sideways_m +
                score[i].turn_rad * motions[i].turn_rad;
  EXPECT_NEAR(by_score, by_column, 1e-6 * size);  // shares of an interval are kept in single precision
}

TEST(Waves, OfTheFloorAreFoundWithTheirLengthAndDirection) {
  const JointModel joint = calibrated(short_case("waves"));
  const std::vector<GenericTest> tests = wave_tests(AskedModel(joint), 0);
  const GenericTest& t = strongest(tests);
  EXPECT_LT(t.p_value, 1e-6);
  EXPECT_EQ(t.channel, "turn per metre [rad/m]");
  // 1.5 m along x; neighbours stand two fifths of a turn over the whole floor apart
  double length_m = 0.0, degrees = 90.0;
  ASSERT_EQ(std::sscanf(t.variable.c_str(), "place, in waves of %lf m towards %lf", &length_m, &degrees), 2)
      << t.variable;
  EXPECT_NEAR(length_m, 1.5, 0.3);
  EXPECT_NEAR(degrees, 0.0, 15.0);
}

TEST(Waves, OfTheFloorAreFoundInALargeHallToo) {
  test::Case c = short_case("waves");
  for (Channel& channel : c.recordings[1].channels)
    if (channel.name == "truth_x_m" || channel.name == "truth_y_m")
      for (double& v : channel.values) v += 13.5;  // nine waves further on
  const std::vector<GenericTest> tests = wave_tests(AskedModel(calibrated(c)), 0);
  double length_m = 0.0, degrees = 90.0;
  ASSERT_EQ(std::sscanf(strongest(tests).variable.c_str(), "place, in waves of %lf m towards %lf", &length_m, &degrees),
            2)
      << strongest(tests).variable;
  EXPECT_NEAR(length_m, 1.5, 0.15);  // neighbours are 0.4 turns in 16 m apart, and a tenth is said
  EXPECT_NEAR(degrees, 0.0, 5.0);
}

TEST(Waves, OfTheFloorUnderEachWheelSayMoreThanUnderTheMiddleOfTheAxle) {
  test::CaseSettings settings;
  settings.effect = "ripples";
  settings.runs = 2;
  settings.duration_s = 40.0;
  const std::vector<GenericTest> tests = wave_tests(AskedModel(calibrated(test::generated_case(settings, 11))), 0);
  const GenericTest& t = strongest(tests);
  EXPECT_EQ(t.channel, "way of the wheel that is there, per metre [1]");
  EXPECT_LT(t.p_value, 1e-6);
  double length_m = 0.0, degrees = 90.0;
  ASSERT_EQ(std::sscanf(t.variable.c_str(), "place, in waves of %lf m towards %lf", &length_m, &degrees), 2)
      << t.variable;
  EXPECT_NEAR(length_m, 1.5, 0.3);  // as above
  EXPECT_NEAR(degrees, 0.0, 15.0);
}

TEST(Waves, OfTimeAreFoundWithTheirPeriod) {
  const JointModel joint = calibrated(short_case("gusts"));
  const std::vector<GenericTest> tests = wave_tests(AskedModel(joint), 0);
  const GenericTest& t = strongest(tests);
  // Over all waves; both runs have phases of their own. Gusts are three times the noise, which has grown with them.
  JointModel with = joint;
  with.accepted.push_back({t.as_effect.get(), {}, std::vector<double>(t.test.value.size(), 0.0)});
  with.fit(2);
  const CandidateTest again = tested_under_own_noise(joint, with, true, kAskedOfGeneric);
  EXPECT_GT(again.statistic, 3.0 * t.test.statistic);
  EXPECT_LT(t.p_value_of(again), 1e-3);
  EXPECT_EQ(t.channel, "carried across the floor [m/s]");
  double period_s = 0.0;
  ASSERT_EQ(std::sscanf(t.variable.c_str(), "time, in waves of %lf s", &period_s), 1) << t.variable;
  EXPECT_NEAR(period_s, 6.0, 0.5);  // neighbours are 0.4 turns in 40 s apart: 0.36 s
}

TEST(Waves, OfAGearAreFoundByHowOftenItTurnsWithItsWheel) {
  const std::vector<GenericTest> tests = wave_tests(AskedModel(calibrated(short_case("gear"))), 0);
  const GenericTest& t = strongest(tests);
  EXPECT_LT(t.p_value, 1e-6);
  EXPECT_EQ(t.channel, "way of the left wheel per metre [1]");
  EXPECT_NEAR(t.times_a_turn, 2.5, 0.01);  // neighbours are 0.4 turns in 20 to 30 turns of the wheel apart
}

TEST(Waves, AreNotFoundInNoise) {
  // p is over all that was looked at; one case in a thousand would fail
  for (const GenericTest& t : wave_tests(AskedModel(calibrated(short_case(""))), 0))
    EXPECT_GT(t.p_value, 1e-3) << t.variable;
}

// Straights at one even speed, a hundredth of a count more than ten from reading to reading, and turns on the spot
// between them: the remainders come back after every hundred readings, 0.47 m. `swing_m`: a heading that comes and goes
// with them.
std::vector<GenericTest> waves_of_even_speed(double swing_m) {
  constexpr double kReading_s = 0.02, kLength_m = 0.47;
  test::Case c;
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.075;
  drive.wheelbase_m = 0.36;
  drive.encoder_counts_per_revolution = 1000.0;
  c.nominal.name = "even";
  c.nominal.kind = drive;
  const double even_radps = 10.01 * 2.0 * kPi / 1000.0 / kReading_s;
  const auto driving = [=](double t) {
    const double u = std::fmod(t, 12.0), turns = u > 10.0 ? 0.5 - 0.5 * std::cos(kPi * (u - 10.0)) : 0.0;
    return u < 10.0 ? test::WheelSpeedsAt{even_radps, 1.0005 * even_radps} : test::WheelSpeedsAt{-turns, turns};
  };
  test::GeneratorSettings g = test::under_motion_capture(drive, 0.0001, 1.0 / 60.0);
  g.truth_position_noise_m = 0.0005;
  g.truth_heading_noise_rad = 0.0005;
  g.duration_s = 48.0;
  g.inject = [=](test::InjectedStep& s) {
    const double way_m = 0.5 * drive.wheel_radius_left_m * (s.left_rad + s.right_rad);
    const double angle = 2.0 * kPi / kLength_m * way_m;
    s.turn_rad += swing_m / drive.wheelbase_m * 2.0 * kPi / kLength_m * std::cos(angle) * 0.5 * (s.left_m + s.right_m);
  };
  Random random(3);
  for (int run = 0; run < 2; ++run) {
    c.recordings.push_back(test::generated(g, driving, random));
    c.recordings.back().name = "run_" + std::to_string(run + 1);
  }
  return wave_tests(AskedModel(calibrated(c)), 0);
}

TEST(Waves, ThatCountingMakesAtAnEvenSpeedAreNone) {
  for (const GenericTest& t : waves_of_even_speed(0.0)) EXPECT_GT(t.p_value, 1e-3) << t.variable << ' ' << t.channel;
}

TEST(Waves, OfAWheelThatIsCarriedFurtherThanItsReadingsHideAreFoundAtAnEvenSpeedToo) {
  const std::vector<GenericTest> tests = waves_of_even_speed(0.001);  // a count is 0.47 mm
  const GenericTest& t = strongest(tests);
  EXPECT_LT(t.p_value, 1e-6);
  EXPECT_EQ(t.channel, "turn per metre [rad/m]");
  EXPECT_EQ(t.variable, "way, in waves of 0.47 m");
}

// Turns that are wider by three hundredths for a fifth of a minute, and narrower for the next, through all recordings.
TEST(Waves, OfAWheelbaseThatFlexesAreFoundWithTheirPeriod) {
  Random random(9);
  test::Case c;
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0005, 1.0 / 60.0);
  g.duration_s = 60.0;
  const auto flexing = [&](int) {
    return [&](test::InjectedStep& s) {
      const double turn_rad = 0.075 * (s.right_radps - s.left_radps) * s.dt_s / 0.34;
      s.turn_rad += 0.03 * std::sin(2.0 * kPi * s.time_s / 25.0) * turn_rad;
    };
  };
  const auto winding = [](int run) -> test::SpeedProfile {
    return [run](double t) {
      const double turn = 2.5 * std::sin((0.4 + 0.1 * run) * t);
      return test::WheelSpeedsAt{4.0 - turn, 4.0 + turn};
    };
  };
  c.recordings = test::three_runs(g, random, winding, flexing);
  const JointModel joint = calibrated(c);
  const std::vector<GenericTest> tests = wave_tests(AskedModel(joint), 0);
  const GenericTest& t = strongest(tests);
  EXPECT_LT(t.p_value, 1e-6);
  EXPECT_EQ(t.channel, "turn per turn [1]");
  double period_s = 0.0;
  ASSERT_EQ(std::sscanf(t.variable.c_str(), "time, in waves of %lf s", &period_s), 1) << t.variable;
  EXPECT_NEAR(period_s, 25.0, 5.0);  // two and a half of them in a recording
}

}  // namespace
}  // namespace odolab
