#include "core/diagnosis/model/joint_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/calibration/least_squares.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

JointModel joint_model(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  const LeastSquaresCalibration calibration = calibrate_least_squares(recordings, nominal).value();
  std::vector<InnovationRun> runs;
  for (const Recording& r : recordings) runs.push_back(innovation_run(r, nominal).value());
  return {std::move(runs), std::vector<char>(recordings.size(), 0), calibration, nominal};
}

// The wheelbase takes up most of a scrub: the likelihood's own difference is then ruled by what a wheelbase a little
// larger or smaller does to the model's covariance, and may be negative.
TEST(JointModel, GainsByAnEffectThatCalibrationNearlyTakesUpWhatItsScorePromises) {
  CaseSettings settings;
  settings.effect = "turn_scrub";
  settings.size = 4.0;
  settings.runs = 3;
  settings.duration_s = 40.0;
  const Case c = generated_case(settings, 7311);
  JointModel joint = joint_model(c.recordings, c.nominal);
  joint.fit(4);
  EXPECT_NEAR(joint.fit(2), 0.0, 0.1) << "fitted already";
  for (const Effect& e : catalogue()) {
    if (e.name != "turn_scrub") continue;
    const CandidateTest t = joint.test(joint.columns_of(e, {0.04}));
    joint.accepted.push_back({&e, {0.04}, {0.0}});
    // The score is that at no scrub; a scrub of 4 % per rad/s is not quite linear.
    EXPECT_NEAR(joint.fit(4), t.statistic, 0.15 * t.statistic);
    EXPECT_GT(t.statistic, 100.0);
  }
}

// Wheels that are larger by what ripples by a third of a percent of it are all but larger wheels, which calibration
// has: undamped, the fit of such a group goes to 3 % of both, one against the other, where what it gains is not linear
// any more.
TEST(JointModel, DoesNotDriftWithAGroupAlongWhatCalibrationNearlyHas) {
  Random random(51);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.001, 0.05);
  g.duration_s = 40.0;
  const auto driving = [&](int) { return varied_driving(random, g.duration_s); };
  const auto nothing = [](int) { return [](InjectedStep&) {}; };
  JointModel joint = joint_model(three_runs(g, random, driving, nothing), Vehicle{});
  joint.fit(4);
  Effect larger;
  larger.amplitudes.resize(1);
  larger.motions = [](const DriveView& view, const std::vector<double>&) {
    Motions m(view.steps.size());
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const double by = 1.0 + 0.003 * std::sin(5.0 * s.time_s);
      m[i] = {by * s.forward_m(), 0.0, by * s.turn_rad};
    }
    return motions_by_number(std::move(m));
  };
  joint.accepted.push_back({.effect = &larger, .shape = {}, .value = {0.0}, .is_damped = true});
  joint.fit(2);
  EXPECT_LT(std::abs(joint.accepted.back().value[0]), 0.005) << "two steps of a twentieth";
}

// The mean radius is the file's, 2 % too small, since only ratios showed while something was missing. At one speed a
// radius that grows with speed is the same; of ends alone, beside a scrub, that had been the name, at p = 5e-127.
TEST(JointModel, TakesTheSizeOfWheelsForNoEffectWhereOnlyRatiosShowed) {
  Random random(50);
  Vehicle nominal;
  GeneratorSettings g;
  g.drive = {0.075, 0.075, 0.34};
  nominal.kind = g.drive;
  g.drive = {0.0765, 0.0765, 0.3468};
  g.truth_position_noise_m = 0.002;
  g.truth_heading_noise_rad = 0.004;
  g.wheel_noise = 3e-4;
  const SpeedProfile straight_and_round = [](double t) {
    const double turns = t < 10.0 ? 0.0 : t < 20.0 ? 0.2 : -0.3;
    return WheelSpeedsAt{4.2 - turns, 4.2 + turns};
  };
  const Recording recording = generated(g, straight_and_round, random);
  LeastSquaresCalibration calibration = calibrate_least_squares({recording}, nominal).value();
  calibration.vehicle = nominal;
  calibration.scale_is_open = true;
  JointModel joint({innovation_run(recording, nominal).value()}, {0}, calibration, nominal);
  joint.linearise();
  for (const Effect& e : catalogue()) {
    if (e.name != "speed_dependent_radius" || e.component != "both_wheels") continue;
    const CandidateTest t = joint.test(joint.columns_of(e, {1.0}));  // with the speed of the vehicle
    EXPECT_LT(t.statistic, 10.0);
    EXPECT_LT(t.survives, 0.01);
  }
  // Nor does a fit move it.
  joint.fit();
  EXPECT_NEAR(joint.model.drive.wheel_radius_left_m + joint.model.drive.wheel_radius_right_m, 0.15, 1e-4);
}

// Wheels that only roll, under a truth of a hundredth of a millimetre: over a metre or a radian nothing errs but what
// is hidden behind the counts of both wheels at both ends. (Without it the errors were four and five times their noise,
// and a robot whose counts were half a millimetre, with nothing missing, was off by twice the noise and so *unknown*.)
TEST(JointModel, KnowsWhatCountsHideAsNoise) {
  Random random(48);
  Vehicle nominal;
  GeneratorSettings g;
  g.drive = {0.075, 0.075, 0.34};
  g.drive.encoder_counts_per_revolution = 300.0;
  nominal.kind = g.drive;
  g.drive.wheel_radius_right_m = 0.0755;  // as alike their counts would come together
  g.truth_period_s = 0.02;
  g.truth_position_noise_m = 1e-5;
  g.truth_heading_noise_rad = 2e-5;
  g.duration_s = 60.0;
  std::vector<Recording> recordings;
  for (int run = 0; run < 3; ++run) recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
  JointModel joint = joint_model(recordings, nominal);
  joint.fit(3);
  joint.fit_noise_and_all();
  const JointModel::GatheredError e = joint.gathered_error();
  ASSERT_GT(e.windows, 30);
  // Of 30 windows and more a mean square is known to a quarter; remainders are not quite even where it turns slowly.
  EXPECT_NEAR(e.heading_rad2 / e.noise_heading_rad2, 1.0, 0.4);
  EXPECT_NEAR(e.position_m2 / e.noise_position_m2, 1.0, 0.4);
}

// A likelihood that gives too much of what headings scatter by to something else, as to coarse counts that are rounded
// alike for some samples, does not make a run that was held out look foreign.
TEST(JointModel, KnowsNoLessNoiseThanHeadingsShow) {
  Random random(49);
  Vehicle nominal;
  GeneratorSettings g;
  g.drive = {0.075, 0.075, 0.34};
  g.counts = false;
  nominal.kind = g.drive;
  g.truth_period_s = 0.02;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.008;
  g.duration_s = 60.0;
  std::vector<Recording> recordings;
  for (int run = 0; run < 3; ++run) recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
  JointModel joint = joint_model(recordings, nominal);
  joint.fit(3);
  joint.fit_noise_and_all();
  joint.model.noise.truth_heading_rad /= 3.0;
  const JointModel::GatheredError e = joint.gathered_error();
  ASSERT_GT(e.windows, 30);
  EXPECT_NEAR(e.heading_rad2 / e.noise_heading_rad2, 1.0, 0.4);  // as above
}

// With one size for both, what moves the body forward alone looked too large to be noise: of thirty recordings of
// another program with nothing missing four were given a load or a drift of both radii.
TEST(JointModel, FindsTheNoiseOfTheWayAndOfTheTurnEachByItself) {
  constexpr double kAlong = 0.003, kTurning = 0.0008;  // per root metre, that of the turn at half a wheelbase
  Random random(47);
  GeneratorSettings g;
  g.drive = {0.075, 0.075, 0.34};
  g.counts = false;
  g.truth_period_s = 0.02;
  g.truth_position_noise_m = 0.0005;
  g.truth_heading_noise_rad = 0.001;
  g.duration_s = 60.0;
  g.inject = [&random](InjectedStep& s) {
    const double root = std::sqrt(0.5 * (std::abs(s.left_m) + std::abs(s.right_m)));
    const double along_m = kAlong * root * random.normal(), turn_m = kTurning * root * random.normal();
    s.left_m += along_m - turn_m;
    s.right_m += along_m + turn_m;
  };
  std::vector<Recording> recordings;
  for (int run = 0; run < 3; ++run) recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
  JointModel joint = joint_model(recordings, Vehicle{});
  joint.fit(4);
  joint.fit_noise();
  const FittedNoise& noise = joint.model.noise;
  const double of_wheels = 0.5 * noise.wheel_m_per_sqrt_m * noise.wheel_m_per_sqrt_m;
  // Some 40 m in ways of a decimetre: a standard deviation is known to 1 / sqrt(2 * 400) = 4 %, and four of those.
  EXPECT_NEAR(std::sqrt(of_wheels + noise.along_m_per_sqrt_m * noise.along_m_per_sqrt_m), kAlong, 0.16 * kAlong);
  EXPECT_NEAR(std::sqrt(of_wheels + noise.turning_m_per_sqrt_m * noise.turning_m_per_sqrt_m), kTurning,
              0.16 * kTurning);
}

// The floor's noise shows in ways of a decimetre, of which a run in which the robot stood has none: it had kept all
// others from saying how large that is, and a bump of theirs had 43 in ln L where it has 16 without that run.
TEST(JointModel, FindsTheNoiseOfTheFloorBesideARunInWhichTheRobotStands) {
  constexpr double kLasts_m = 0.15, kUneven = 0.01;
  Random random(52);
  GeneratorSettings g;
  g.drive = {0.075, 0.075, 0.34};
  g.truth_period_s = 0.02;
  g.truth_position_noise_m = 0.0005;
  g.truth_heading_noise_rad = 0.001;
  g.duration_s = 40.0;
  double left = 0.0, right = 0.0;
  g.inject = [&](InjectedStep& s) {
    for (const auto& [way_m, share] : {std::pair{&s.left_m, &left}, std::pair{&s.right_m, &right}}) {
      const double stays = std::exp(-std::abs(*way_m) / kLasts_m);
      *share = stays * *share + std::sqrt(1.0 - stays * stays) * kUneven * random.normal();
      *way_m *= 1.0 + *share;
    }
  };
  std::vector<Recording> recordings;
  for (int run = 0; run < 2; ++run) recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
  const auto wheel_noise = [](const std::vector<Recording>& of) {
    JointModel joint = joint_model(of, Vehicle{});
    joint.fit(4);
    joint.fit_noise();
    return joint.model.noise.wheel_m_per_sqrt_m;
  };
  const double alone = wheel_noise(recordings);
  g.duration_s = 10.0;
  recordings.push_back(generated(g, [](double) { return WheelSpeedsAt{}; }, random));
  // It tells of the truth alone, whose noise is known to a percent.
  EXPECT_NEAR(wheel_noise(recordings) / alone, 1.0, 0.02);
}

TEST(JointModel, FindsTheSameNoiseWhicheverRunComesFirst) {
  Random random(53);
  GeneratorSettings g;
  g.drive = {0.075, 0.075, 0.34};
  g.wheel_noise = 0.002;
  g.truth_period_s = 0.01;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.002;
  std::vector<Recording> recordings;
  for (const double duration_s : {60.0, 65.0}) {  // 12 500 samples: every second stretch of 250 is looked at
    g.duration_s = duration_s;
    recordings.push_back(generated(g, varied_driving(random, duration_s), random));
  }
  const auto noise = [](const std::vector<Recording>& of) {
    JointModel joint = joint_model(of, Vehicle{});
    joint.fit(4);
    joint.fit_noise();
    return joint.model.noise;
  };
  const FittedNoise one = noise(recordings), other = noise({recordings[1], recordings[0]});
  // Other stretches would differ by what noise is known to, 1 %; sums in another order by rounding.
  EXPECT_NEAR(other.wheel_m_per_sqrt_m / one.wheel_m_per_sqrt_m, 1.0, 1e-3);
  EXPECT_NEAR(other.truth_position_m / one.truth_position_m, 1.0, 1e-3);
  EXPECT_NEAR(other.truth_heading_rad / one.truth_heading_rad, 1.0, 1e-3);
}

// Whether the truth's frame is off by much is asked of a sample as recorded, of which one run had ten times as many.
TEST(JointModel, KnowsWhetherTheTruthComesBackWhicheverRunComesFirst) {
  constexpr double kOff_m = 0.0015, kLasts_s = 2.0;
  Random random(54);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.001, 0.1);
  g.duration_s = 60.0;
  std::vector<InnovationRun> runs;
  std::vector<Recording> recordings;
  for (const double samples_averaged : {1.0, 10.0}) {
    Recording r = generated(g, varied_driving(random, g.duration_s), random);
    const double stays = std::exp(-g.truth_period_s / kLasts_s);
    for (const char* name : {"truth_x_m", "truth_y_m"}) {
      double off_m = 0.0;
      for (Channel& channel : r.channels)
        for (double& value : channel.values) {
          if (channel.name != name || std::isnan(value)) continue;
          off_m = stays * off_m + std::sqrt(1.0 - stays * stays) * kOff_m * random.normal();
          value += off_m;
        }
    }
    runs.push_back(innovation_run(r, Vehicle{}).value());
    runs.back().samples_averaged = samples_averaged;
    recordings.push_back(std::move(r));
  }
  const LeastSquaresCalibration calibration = calibrate_least_squares(recordings, Vehicle{}).value();
  const auto lasts_s = [&](std::vector<InnovationRun> of) {
    JointModel joint(std::move(of), {0, 0}, calibration, Vehicle{});
    joint.fit(3);
    joint.fit_noise();
    return joint.model.noise.wander_lasts_s;
  };
  EXPECT_EQ(lasts_s(runs), lasts_s({runs[1], runs[0]}));
}

// Wheels of 500 counts at even speeds, under a truth that is truer than they: what is hidden between two counts lasts.
TEST(JointModel, BelievesTheLikelihoodWhereInnovationsAreCorrelatedByWholeCountsAlone) {
  Random random(48);
  DifferentialDrive drive{0.075, 0.075, 0.34};
  drive.encoder_counts_per_revolution = 500.0;
  GeneratorSettings g = under_motion_capture(drive, 0.0003, 0.05);
  g.truth_position_noise_m = g.truth_heading_noise_rad = 0.0003;
  g.duration_s = 60.0;
  // Three counts and a little more from reading to reading: a remainder comes back after twelve to thirty of them.
  const auto even = [&](int run) -> SpeedProfile {
    const double count_radps = 2.0 * kPi / drive.counts_per_wheel_turn() / g.wheel_period_s;
    return [=](double t) {
      const double bend = 0.002 + 0.001 * std::floor(t / 10.0), speed = (3.04 + 0.02 * run) * count_radps;
      return WheelSpeedsAt{speed * (1.0 - bend), speed * (1.0 + bend)};
    };
  };
  Vehicle nominal;
  nominal.kind = drive;
  JointModel joint = joint_model(three_runs(g, random, even, [](int) { return nullptr; }), nominal);
  joint.fit(4);
  joint.fit_noise_and_all();
  EXPECT_EQ(joint.distrust(), 0.0);
}

// A push is one recording's own, the clocks are all recordings'.
TEST(JointModel, KeepsEachClockWhereOthersLackWhatHappenedInOneRecording) {
  CaseSettings settings;
  settings.runs = 2;
  settings.duration_s = 20.0;
  const Case c = generated_case(settings, 7312);
  JointModel joint = joint_model(c.recordings, c.nominal), others = joint_model({c.recordings[1]}, c.nominal);
  joint.linearise();
  others.linearise();
  for (const Effect& e : catalogue())
    if (e.name == "collision" && joint.accepted.empty())
      joint.accepted.push_back({&e, {0.0, 10.0, 0.0}, {0.0, 0.0, 0.0}});
  joint.accepted.push_back({&effects::clock_rate_of_each_run(2).front(), {}, {1e-4, 2e-4}});
  others.accepted.push_back({&effects::clock_rate_of_each_run(1).front(), {}, {3e-4}});
  const JointModel all = joint.together_with(others);
  ASSERT_EQ(all.accepted.size(), 2u);
  EXPECT_EQ(all.accepted[1].value, (std::vector<double>{1e-4, 2e-4, 3e-4}));
}

// Calibration may have learned nothing of a wheelbase because something else is missing: then its noise is no noise.
TEST(JointModel, MovesALengthOfWhichNothingWasLearnedOnlyWhereInnovationsAreCorrelated) {
  Random random(57);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.05);
  g.duration_s = 40.0;
  const auto driving = [&](int) { return varied_driving(random, g.duration_s); };
  const auto nothing = [](int) { return [](InjectedStep&) {}; };
  const std::vector<Recording> recordings = three_runs(g, random, driving, nothing);
  Vehicle file;
  const double wheelbase_m = g.drive.wheelbase_m, believed_m = 1.02 * wheelbase_m;
  std::get<DifferentialDrive>(file.kind).wheelbase_m = believed_m;
  for (const bool correlated : {false, true}) {
    LeastSquaresCalibration told;
    told.vehicle = file;
    told.noise = {5e-4, 1e-3, 2e-3};
    told.innovations_are_correlated = correlated;
    ParameterEstimate wheelbase;
    wheelbase.name = "wheelbase_m";
    wheelbase.stderr_value = 0.05 * believed_m;
    wheelbase.determined = false;
    told.parameters = {wheelbase};
    std::vector<InnovationRun> runs;
    for (const Recording& r : recordings) runs.push_back(innovation_run(r, file).value());
    JointModel joint(std::move(runs), std::vector<char>(recordings.size(), 0), told, file);
    joint.fit(4);
    // A hundredth of a metre of noise in half a minute of turns: to less than a thousandth of the wheelbase.
    EXPECT_NEAR(joint.model.drive.wheelbase_m, correlated ? wheelbase_m : believed_m, 1e-3 * wheelbase_m);
  }
}

}  // namespace
}  // namespace odolab::test
