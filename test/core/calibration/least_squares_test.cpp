#include "core/calibration/least_squares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/formatted.h"
#include "test/support/drive_generator.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

using test::GeneratorSettings;

// A LabMate whose machine differs from its drawing: radii by 2 %, wheelbase by 5 %, tracked point off the axle's
// centre.
GeneratorSettings off_the_drawing() {
  GeneratorSettings g;
  g.drive.wheel_radius_left_m = 0.075 * 1.02;
  g.drive.wheel_radius_right_m = 0.075 * 1.015;
  g.drive.wheelbase_m = 0.340 * 1.05;
  g.truth.axle_T_tracked = {0.05, -0.03, 0.04};
  g.truth.time_offset_s = 0.03;
  g.wheel_noise = 0.003;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.003;
  return g;
}

std::map<std::string, double> true_values(const GeneratorSettings& g) {
  return {{"wheel_radius_left_m", g.drive.wheel_radius_left_m},
          {"wheel_radius_right_m", g.drive.wheel_radius_right_m},
          {"wheelbase_m", g.drive.wheelbase_m},
          {"truth_mounting.x_m", g.truth.axle_T_tracked.x_m},
          {"truth_mounting.y_m", g.truth.axle_T_tracked.y_m},
          {"truth_mounting.heading_rad", g.truth.axle_T_tracked.heading_rad},
          {"truth_mounting.time_offset_s", g.truth.time_offset_s}};
}

Vehicle labmate() { return Vehicle{"LabMate", DifferentialDrive{}, {}}; }

const ParameterEstimate& named(const LeastSquaresCalibration& c, const std::string& name) {
  for (const ParameterEstimate& p : c.parameters)
    if (p.name == name) return p;
  static const ParameterEstimate none{};
  ADD_FAILURE() << "no parameter " << name;
  return none;
}

bool says(const std::vector<std::string>& sentences, const std::string& words) {
  for (const std::string& s : sentences)
    if (s.find(words) != std::string::npos) return true;
  return false;
}

test::WheelSpeedsAt straight(double t) {
  const double v = 4.0 * std::sin(kPi * t / 30.0);
  return {v, v};
}

test::WheelSpeedsAt spin(double t) {
  const double v = 3.0 * std::sin(2.0 * kPi * t / 30.0);
  return {-v, v};
}

// Counts how often each claimed interval holds its true value.
struct Coverage {
  std::map<std::string, int> held;
  int runs = 0;

  void add(const LeastSquaresCalibration& c, const std::map<std::string, double>& truth) {
    ++runs;
    for (const ParameterEstimate& p : c.parameters) {
      if (!p.determined) continue;
      const double z = (p.value - truth.at(p.name)) / p.stderr_value;
      held[p.name] += std::abs(z) < 1.96;
    }
  }
  // With 200 runs at 95 % the number held has a standard deviation of sqrt(200 * 0.95 * 0.05) = 3.1 runs or 1.5 %: 90
  // to 99 % is three of them, on either side.
  void expect_honest(const std::string& name) {
    const double share = static_cast<double>(held[name]) / runs;
    EXPECT_GE(share, 0.90) << name;
    EXPECT_LE(share, 0.99) << name;
  }
};

TEST(LeastSquares, RecoversRadiiWrongByTwoPercentAndWheelbaseByFive) {
  Random random(1);
  const GeneratorSettings g = off_the_drawing();
  const auto result = calibrate_least_squares({generated(g, test::rich_driving, random)}, labmate());
  ASSERT_TRUE(result.ok()) << result.error().message();
  for (const auto& [name, value] : true_values(g)) {
    const ParameterEstimate& p = named(*result, name);
    EXPECT_TRUE(p.determined) << name;
    EXPECT_NEAR(p.value, value, 4.0 * p.stderr_value) << name;  // four standard errors: 6e-5 by chance
  }
  EXPECT_TRUE(result->cannot_tell.empty());
  EXPECT_GT(result->normalised_chi2_nominal, 2.0);
  EXPECT_NEAR(result->normalised_chi2, 1.0, 0.1);  // 1800 innovations: their mean square scatters by 3 %
  EXPECT_NEAR(result->noise.truth_position_m, 0.001, 0.0002);
  EXPECT_NEAR(result->noise.wheel_m_per_sqrt_m, 0.003, 0.0008);
}

TEST(LeastSquares, ClaimsIntervalsThatHoldInRichDriving) {
  Coverage coverage;
  for (int i = 0; i < 200; ++i) {
    Random random(seed_of_stream(7, i));
    GeneratorSettings g = off_the_drawing();
    const auto result = calibrate_least_squares({generated(g, test::rich_driving, random)}, labmate());
    ASSERT_TRUE(result.ok());
    coverage.add(*result, true_values(g));
  }
  for (const auto& [name, value] : true_values(off_the_drawing())) coverage.expect_honest(name);
}

TEST(LeastSquares, ClaimsIntervalsThatHoldWithTruthAtStartAndEndOnly) {
  Coverage coverage;
  for (int i = 0; i < 200; ++i) {
    Random random(seed_of_stream(8, i));
    GeneratorSettings g = off_the_drawing();
    g.truth = {};
    g.truth_period_s = 0.0;
    g.truth_position_noise_m = 0.002;  // the sonar corner of the UMBmark report
    g.truth_heading_noise_rad = 0.007;
    g.wheel_period_s = 0.1;
    g.step_s = 0.004;
    std::vector<Recording> runs;
    for (int k = 0; k < 10; ++k) {
      const auto profile = test::square_driving(DifferentialDrive{}, 2.0, k % 2 == 0, &g.duration_s);
      runs.push_back(generated(g, profile, random));
    }
    // A tape measure's straight gives the scale, which a closed path hides.
    g.duration_s = 10.0;
    for (int k = 0; k < 2; ++k)
      runs.push_back(generated(
          g, [](double t) { return straight(3.0 * t); }, random));
    const auto result = calibrate_least_squares(runs, labmate());
    ASSERT_TRUE(result.ok());
    coverage.add(*result, true_values(g));
    EXPECT_FALSE(named(*result, "truth_mounting.time_offset_s").determined);
  }
  for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"}) coverage.expect_honest(name);
}

TEST(LeastSquares, SaysThatAStraightCannotTellTheWheelbase) {
  Random random(2);
  const auto result = calibrate_least_squares({generated(off_the_drawing(), straight, random)}, labmate());
  ASSERT_TRUE(result.ok());
  const ParameterEstimate& wheelbase = named(*result, "wheelbase_m");
  EXPECT_FALSE(wheelbase.determined);
  EXPECT_EQ(wheelbase.value, 0.340);  // kept
  EXPECT_TRUE(says(result->cannot_tell, "wheelbase_m: the robot hardly turned"));
  EXPECT_TRUE(says(result->cannot_tell, "truth_mounting."));
  // What a straight does tell stays right: the mean radius and the direction in which the truth's heading is mounted.
  const double mean =
      0.5 * (named(*result, "wheel_radius_left_m").value + named(*result, "wheel_radius_right_m").value);
  EXPECT_NEAR(mean, 0.5 * 0.075 * (1.02 + 1.015), 4 * named(*result, "wheel_radius_left_m").stderr_value);
}

TEST(LeastSquares, SaysThatOneWheelAloneCannotTellTheWheelbase) {
  Random random(4);
  const auto about_the_left = [](double t) { return test::WheelSpeedsAt{0.0, straight(t).right_radps}; };
  const auto result = calibrate_least_squares({generated(off_the_drawing(), about_the_left, random)}, labmate());
  ASSERT_TRUE(result.ok());
  EXPECT_FALSE(named(*result, "wheel_radius_left_m").determined);
  EXPECT_TRUE(says(result->cannot_tell, "wheelbase_m: one wheel alone rolled"));
}

TEST(LeastSquares, TellsOfASpinTheRatioOfWheelbaseToRadiusAndNotTheScale) {
  Random random(3);
  const GeneratorSettings g = off_the_drawing();
  const auto result = calibrate_least_squares({generated(g, spin, random)}, labmate());
  ASSERT_TRUE(result.ok());
  for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "truth_mounting.heading_rad"}) {
    EXPECT_FALSE(named(*result, name).determined) << name;
    EXPECT_EQ(named(*result, name).value, named(*result, name).nominal) << name;
  }
  const ParameterEstimate& wheelbase = named(*result, "wheelbase_m");
  EXPECT_TRUE(wheelbase.determined);
  std::map<std::string, double> truth = true_values(g);
  const double true_ratio =
      truth["wheelbase_m"] / (0.5 * (truth["wheel_radius_left_m"] + truth["wheel_radius_right_m"]));
  EXPECT_NEAR(wheelbase.value / 0.075, true_ratio, 4 * wheelbase.stderr_value / 0.075);
  EXPECT_TRUE(says(result->cannot_tell, "only their ratios show here, not the scale"));
  EXPECT_TRUE(says(result->cannot_tell, "drive a straight"));
}

TEST(LeastSquares, JoinsWhatTwoRecordingsTellSingly) {
  Random random(4);
  const GeneratorSettings g = off_the_drawing();
  const auto result = calibrate_least_squares({generated(g, straight, random), generated(g, spin, random)}, labmate());
  ASSERT_TRUE(result.ok());
  for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"}) {
    EXPECT_TRUE(named(*result, name).determined) << name;
    EXPECT_NEAR(named(*result, name).value, true_values(g).at(name), 4 * named(*result, name).stderr_value) << name;
  }
}

TEST(LeastSquares, NeedsNoHeadingInTheTruth) {
  Random random(5);
  GeneratorSettings g = off_the_drawing();
  g.truth_has_heading = false;
  g.start = {1.0, -2.0, 2.5};  // the first heading is anything
  const auto result = calibrate_least_squares({generated(g, test::rich_driving, random)}, labmate());
  ASSERT_TRUE(result.ok());
  for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m", "truth_mounting.x_m",
                           "truth_mounting.y_m", "truth_mounting.time_offset_s"}) {
    EXPECT_TRUE(named(*result, name).determined) << name;
    EXPECT_NEAR(named(*result, name).value, true_values(g).at(name), 4 * named(*result, name).stderr_value) << name;
  }
  EXPECT_FALSE(named(*result, "truth_mounting.heading_rad").determined);
  EXPECT_TRUE(says(result->cannot_tell, "the truth has no heading"));
}

TEST(LeastSquares, ReadsTruthAtTwoAndAtTwoHundredHertz) {
  for (const double period : {0.5, 0.005}) {
    Random random(6);
    GeneratorSettings g = off_the_drawing();
    g.truth_period_s = period;
    const auto result = calibrate_least_squares({generated(g, test::rich_driving, random)}, labmate());
    ASSERT_TRUE(result.ok());
    for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"})
      EXPECT_NEAR(named(*result, name).value, true_values(g).at(name), 4 * named(*result, name).stderr_value)
          << name << " " << period;
    EXPECT_NEAR(result->normalised_chi2, 1.0, 0.15);
  }
}

TEST(LeastSquares, WorksWithoutAnyNoise) {
  for (const bool counts : {true, false}) {
    Random random(15);
    GeneratorSettings g = off_the_drawing();
    g.wheel_noise = g.truth_position_noise_m = g.truth_heading_noise_rad = 0.0;
    g.counts = counts;
    const auto result = calibrate_least_squares({generated(g, test::rich_driving, random)}, labmate());
    ASSERT_TRUE(result.ok());
    // What is left: rounding of the counts, and acceleration between wheel samples, a dt^2 / 8 = 0.05 mm or 0.3 mrad at
    // most.
    for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"})
      EXPECT_NEAR(named(*result, name).value / true_values(g).at(name), 1.0, 3e-4) << name << counts;
  }
}

TEST(LeastSquares, CalibratesASlowRobotWithCoarseCountsAndAFineTruth) {
  Random random(16);
  GeneratorSettings g = off_the_drawing();
  g.drive.encoder_counts_per_revolution = 360;
  g.wheel_period_s = 0.005;
  g.truth_period_s = 1.0 / 120.0;
  g.truth_position_noise_m = g.truth_heading_noise_rad = 2e-4;
  g.wheel_noise = 0.0;
  Vehicle drawing = labmate();
  std::get<DifferentialDrive>(drawing.kind).encoder_counts_per_revolution = 360;
  const test::SpeedProfile slowly = [](double t) {
    const test::WheelSpeedsAt w = test::rich_driving(t);
    return test::WheelSpeedsAt{0.4 * w.left_radps, 0.4 * w.right_radps};
  };
  const auto result = calibrate_least_squares({generated(g, slowly, random)}, drawing);
  ASSERT_TRUE(result.ok());
  // A count is 1.3 mm of a way of some metres, and averages out over a thousand of them: a thousandth is a wide bound.
  // With the counts as they were read, radii came out 1 % wrong.
  for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"})
    EXPECT_NEAR(named(*result, name).value / true_values(g).at(name), 1.0, 1e-3) << name;
}

TEST(LeastSquares, SetsOutliersAndFrozenTruthAside) {
  Random random(9);
  const GeneratorSettings g = off_the_drawing();
  Recording recording = generated(g, test::rich_driving, random);
  std::vector<double>&x = recording.channels[2].values, &y = recording.channels[3].values,
  &heading = recording.channels[4].values;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isnan(x[i])) rows.push_back(i);
  for (const std::size_t k : {60u, 200u, 340u, 470u}) x[rows[k]] += 0.3;
  for (std::size_t k = 400; k < 430; ++k) {  // 1.5 s frozen on the move
    x[rows[k]] = x[rows[400]];
    y[rows[k]] = y[rows[400]];
    heading[rows[k]] = heading[rows[400]];
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 130; k < 180; ++k) x[rows[k]] = y[rows[k]] = heading[rows[k]] = nan;  // a gap of 2.5 s
  const auto result = calibrate_least_squares({recording}, labmate());
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->outliers, 4);
  EXPECT_TRUE(says(result->warnings, formatted("at %.2f, %.2f, %.2f s and 1 more", recording.time_s[rows[60]],
                                               recording.time_s[rows[200]], recording.time_s[rows[340]])));
  EXPECT_TRUE(says(result->warnings, "repeat themselves"));
  for (const auto& [name, value] : true_values(g))
    EXPECT_NEAR(named(*result, name).value, value, 4 * named(*result, name).stderr_value) << name;
  EXPECT_NEAR(result->noise.truth_position_m, 0.001, 0.0002);  // 500 samples: 3 %; the outliers did not enter
}

TEST(LeastSquares, AsksForDiametersWhereBothRadiiAreHalfOfWhatTheFileSays) {
  Random random(12);
  const GeneratorSettings g = off_the_drawing();
  Vehicle diameters = labmate();
  auto& drive = std::get<DifferentialDrive>(diameters.kind);
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.150;
  const auto result = calibrate_least_squares({generated(g, test::rich_driving, random)}, diameters);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_TRUE(says(result->warnings,
                   "both wheels seem 0.5 times as large as the vehicle's file has them: diameters in place of radii? "
                   "Or its encoder_counts_per_revolution may be two times too small"));
}

TEST(LeastSquares, ComesBackAfterTheRobotWasMovedByHand) {
  Random random(10);
  const GeneratorSettings g = off_the_drawing();
  Recording recording = generated(g, test::rich_driving, random);
  for (std::size_t i = 0; i < recording.time_s.size(); ++i)
    if (recording.time_s[i] > 14.0) recording.channels[2].values[i] += 0.8;
  const auto result = calibrate_least_squares({recording}, labmate());
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(says(result->warnings, "starts anew"));
  for (const auto& [name, value] : true_values(g))
    EXPECT_NEAR(named(*result, name).value, value, 4 * named(*result, name).stderr_value) << name;
}

TEST(LeastSquares, FindsTheClockOfEachRecording) {
  Random random(11);
  GeneratorSettings early = off_the_drawing(), late = off_the_drawing();
  early.truth.time_offset_s = -0.04;
  late.truth.time_offset_s = 0.06;
  const std::vector<Recording> recordings = {generated(early, test::rich_driving, random),
                                             generated(late, test::rich_driving, random)};
  const auto result = calibrate_least_squares(recordings, labmate());
  ASSERT_TRUE(result.ok());
  EXPECT_NEAR(result->time_offset_s[0], -0.04, 0.003);  // four standard errors of about 0.6 ms
  EXPECT_NEAR(result->time_offset_s[1], 0.06, 0.003);
  EXPECT_TRUE(says(result->warnings, "clock differs between the recordings"));
  EXPECT_NEAR(named(*result, "wheelbase_m").value, early.drive.wheelbase_m,
              4 * named(*result, "wheelbase_m").stderr_value);
  LeastSquaresOptions one;
  one.one_truth_clock = true;
  const auto shared = calibrate_least_squares(recordings, labmate(), one);
  ASSERT_TRUE(shared.ok());
  EXPECT_GT(shared->noise.wheel_m_per_sqrt_m, 2 * result->noise.wheel_m_per_sqrt_m);  // the misfit goes into the noise
}

TEST(LeastSquares, AsksWhetherTheFileIsAnotherVehiclesWhereNoLengthIsNearIt) {
  Random random(13);
  const std::vector<Recording> recordings = {generated(off_the_drawing(), test::rich_driving, random)};
  const auto of_file = [&](double wheels_times, double wheelbase_times) {
    Vehicle file = labmate();
    auto& drive = std::get<DifferentialDrive>(file.kind);
    drive.wheel_radius_left_m *= wheels_times, drive.wheel_radius_right_m *= wheels_times;
    drive.wheelbase_m *= wheelbase_times;
    const auto result = calibrate_least_squares(recordings, file);
    return result.ok() && says(result->warnings, "is it another vehicle's?");
  };
  EXPECT_TRUE(of_file(0.6, 1.6));
  EXPECT_FALSE(of_file(1.0, 1.6));  // a wheelbase mistyped
  EXPECT_FALSE(of_file(2.0, 1.0));  // diameters in place of radii
}

TEST(LeastSquares, SaysThatTheTruthWobblesAndIsNotBentByIt) {
  Random random(12);
  const GeneratorSettings g = off_the_drawing();
  Recording recording = generated(g, test::rich_driving, random);
  for (std::size_t i = 0; i < recording.time_s.size(); ++i)
    recording.channels[2].values[i] += 0.003 * std::sin(3.0 * recording.time_s[i]);
  const auto result = calibrate_least_squares({recording}, labmate());
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(says(result->warnings, "the truth's noise lasts"));
  // Samples are independent a quarter of the wobble's period apart, 0.52 s: of what is tried 0.5 or 0.75 s.
  EXPECT_NEAR(result->truth_apart_s, 0.625, 0.13);
  const DifferentialDrive found = std::get<DifferentialDrive>(result->vehicle.kind);
  // Four standard errors: passed by chance all but once in 5000 times for three parameters.
  EXPECT_LT(std::abs(found.wheel_radius_left_m - g.drive.wheel_radius_left_m),
            4.0 * result->parameters[0].stderr_value);
  EXPECT_LT(std::abs(found.wheel_radius_right_m - g.drive.wheel_radius_right_m),
            4.0 * result->parameters[1].stderr_value);
  EXPECT_LT(std::abs(found.wheelbase_m - g.drive.wheelbase_m), 4.0 * result->parameters[2].stderr_value);
}

TEST(LeastSquares, GivesTheCovarianceOfWhatItDetermines) {
  Random random(13);
  const auto result = calibrate_least_squares({generated(off_the_drawing(), test::rich_driving, random)}, labmate());
  ASSERT_TRUE(result.ok());
  std::size_t determined = 0;
  for (const ParameterEstimate& p : result->parameters) determined += p.determined;
  ASSERT_EQ(result->covariance.size(), determined * determined);
  std::size_t k = 0;
  for (const ParameterEstimate& p : result->parameters) {
    if (!p.determined) continue;
    EXPECT_NEAR(std::sqrt(result->covariance[k * determined + k]), p.stderr_value, 1e-12);
    ++k;
  }
  // The two radii err together: the truth knows the travel better than the difference of two wheels on a wide base.
  EXPECT_NEAR(result->covariance[1], result->covariance[determined], 1e-18);
}

TEST(LeastSquares, RefusesWhatItCannotUse) {
  Random random(14);
  GeneratorSettings g = off_the_drawing();
  g.duration_s = 2.0;
  EXPECT_EQ(calibrate_least_squares({}, labmate()).error().where, "recordings");
  Recording no_truth = generated(g, test::rich_driving, random);
  no_truth.channels.resize(2);
  EXPECT_NE(calibrate_least_squares({no_truth}, labmate()).error().message().find("0 truth samples"),
            std::string::npos);
  Recording no_wheels = generated(g, test::rich_driving, random);
  no_wheels.channels.erase(no_wheels.channels.begin(), no_wheels.channels.begin() + 2);
  EXPECT_NE(calibrate_least_squares({no_wheels}, labmate()).error().message().find("no wheel rotation"),
            std::string::npos);
  Vehicle broken = labmate();
  broken.kind = DifferentialDrive{0.0, 0.075, 0.34, 2000.0, 1.0, 0};
  EXPECT_NE(calibrate_least_squares({no_truth}, broken).error().message().find("wheel_radius_left_m"),
            std::string::npos);
  Recording good = generated(g, test::rich_driving, random);
  EXPECT_EQ(calibrate_least_squares({good}, labmate(), {}, [](double) { return false; }).error().where, "calibration");
}

// Squares both ways of which only the poses at both ends are known, measured with a ruler.
TEST(LeastSquares, KeepsTheRatiosThatPosesAtBothEndsShow) {
  GeneratorSettings g;
  g.drive.wheel_radius_left_m = 0.075 * 0.99;
  g.drive.wheel_radius_right_m = 0.075 * 0.994;
  g.drive.wheelbase_m = 0.340 * 0.97;
  g.truth_period_s = 0.0;
  g.wheel_noise = 0.0003;
  g.truth_position_noise_m = 0.002;
  g.truth_heading_noise_rad = 0.005;
  Random random(9);
  std::vector<Recording> recordings;
  for (int run = 0; run < 8; ++run) {
    const test::SpeedProfile square = test::square_driving(DifferentialDrive{}, 3.0, run % 2 == 0, &g.duration_s);
    recordings.push_back(generated(g, square, random));
  }
  const auto result = calibrate_least_squares(recordings, labmate());
  ASSERT_TRUE(result.ok());
  const ParameterEstimate &left = named(*result, "wheel_radius_left_m"),
                          &right = named(*result, "wheel_radius_right_m"), &base = named(*result, "wheelbase_m");
  EXPECT_TRUE(left.determined && right.determined && base.determined);
  EXPECT_NEAR(0.5 * (left.value + right.value), 0.075, 1e-6);                               // as it was given
  EXPECT_NEAR(right.value / left.value, 0.994 / 0.99, 8 * left.stderr_value / left.value);  // both move apart: 4 sigma
  EXPECT_NEAR(base.value / 0.075, g.drive.wheelbase_m / (0.075 * 0.992), 4 * base.stderr_value / 0.075);
  EXPECT_TRUE(says(result->cannot_tell, "only their ratios show here, not the scale"));
  EXPECT_TRUE(says(result->cannot_tell, "measure the poses at both ends of a straight"));  // driven it has
}

TEST(LeastSquares, IsNotBiasedByWheelsThatAreReadTenTimesASecond) {
  GeneratorSettings g = off_the_drawing();
  g.truth.time_offset_s = 0.002;
  g.wheel_noise = 0.0003;
  g.wheel_period_s = g.truth_period_s = 0.1;
  g.truth_phase_s = 0.0;
  g.truth_position_noise_m = 0.0007;
  g.truth_heading_noise_rad = 0.0015;
  g.duration_s = 60.0;
  Random random(21);
  std::vector<Recording> recordings;
  for (int run = 0; run < 4; ++run) {
    Random drive(100 + static_cast<std::uint64_t>(run));
    recordings.push_back(generated(g, test::varied_driving(drive, g.duration_s), random));
  }
  const auto result = calibrate_least_squares(recordings, labmate());
  ASSERT_TRUE(result.ok());
  for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"})
    EXPECT_NEAR(named(*result, name).value, true_values(g)[name], 4 * named(*result, name).stderr_value) << name;
  EXPECT_LT(named(*result, "wheelbase_m").stderr_value, 2e-4);  // a thousandth, as much as chords would err by
}

// A double knows such a stamp to a quarter of a microsecond.
TEST(LeastSquares, SaysTheSameOfStampsThatCountFromNineteenSeventy) {
  GeneratorSettings g = off_the_drawing();
  g.wheel_period_s = 0.05;
  g.truth_period_s = 0.023;
  g.duration_s = 40.0;
  Random random(22), drive(122);
  Recording recording = generated(g, test::varied_driving(drive, g.duration_s), random);
  const auto from_zero = calibrate_least_squares({recording}, labmate());
  for (double& time_s : recording.time_s) time_s += 1713157448.23175;
  const auto from_1970 = calibrate_least_squares({recording}, labmate());
  ASSERT_TRUE(from_zero.ok() && from_1970.ok());
  for (const char* name : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"})
    EXPECT_NEAR(named(*from_1970, name).value, named(*from_zero, name).value,
                0.01 * named(*from_zero, name).stderr_value)
        << name;
}

TEST(LeastSquares, RefusesATruthThatHasNothingToDoWithTheWheels) {
  GeneratorSettings g = off_the_drawing();
  Random random(12);
  Recording r = test::generated(g, test::varied_driving(random, g.duration_s), random);
  for (Channel& c : r.channels)
    if (c.name == "truth_x_m" || c.name == "truth_y_m")
      for (double& v : c.values)
        if (!std::isnan(v)) v = random.uniform(0.0, 1.0);
  const Result<LeastSquaresCalibration> calibration = calibrate_least_squares({r}, Vehicle{});
  ASSERT_FALSE(calibration);
  EXPECT_NE(calibration.error().expected.find("of one robot"), std::string::npos) << calibration.error().message();
}

// Of many samples the noise is fitted to some stretches: which of them must not hang on which run was given first,
// where some runs were measured worse than others.
TEST(LeastSquares, IsTheSameInWhateverOrderRunsAreGiven) {
  test::CaseSettings settings;
  settings.runs = 5;
  settings.duration_s = 40.0;
  test::Case c = test::generated_case(settings, 12);
  Random random(5);
  for (Channel& channel : c.recordings[1].channels)
    if (channel.name == "truth_x_m" || channel.name == "truth_y_m")
      for (double& value : channel.values) value += 0.003 * random.normal();
  c.recordings[1].time_s.resize(c.recordings[1].time_s.size() * 9 / 10);  // no run is as long as another
  c.recordings[3].time_s.resize(c.recordings[3].time_s.size() * 4 / 5);
  c.recordings[4].time_s.resize(c.recordings[4].time_s.size() * 7 / 10);
  c.recordings[0].time_s.resize(c.recordings[0].time_s.size() * 19 / 20);
  for (Recording& r : c.recordings)
    for (Channel& channel : r.channels) channel.values.resize(r.time_s.size());
  const auto given = calibrate_least_squares(c.recordings, c.nominal);
  std::reverse(c.recordings.begin(), c.recordings.end());
  const auto reversed = calibrate_least_squares(c.recordings, c.nominal);
  ASSERT_TRUE(given && reversed);
  EXPECT_NEAR(reversed->noise.truth_position_m / given->noise.truth_position_m, 1.0, 0.001);
  EXPECT_NEAR(reversed->noise.wheel_m_per_sqrt_m / given->noise.wheel_m_per_sqrt_m, 1.0, 0.01);
  for (const char* name : {"wheel_radius_left_m", "wheelbase_m"})
    EXPECT_NEAR(named(*reversed, name).stderr_value / named(*given, name).stderr_value, 1.0, 0.01) << name;
}

}  // namespace
}  // namespace odolab
