#include "core/calibration/recording_fault.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/calibration/least_squares.h"
#include "core/calibration/run_fit.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

constexpr double kRunTime_s = 40.0;

std::vector<Recording> three_runs(const test::Case& c) {
  std::vector<Recording> runs = c.recordings;
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].name = "run_" + std::to_string(i + 1) + ".csv";
  return runs;
}

test::Case faulty_case(const std::string& effect, double size, std::uint64_t seed) {
  test::CaseSettings s;
  s.effect = effect;
  s.size = size;
  s.runs = 3;
  s.duration_s = kRunTime_s;
  return test::generated_case(s, seed);
}

std::vector<double>& column(Recording& r, const std::string& name) {
  for (Channel& c : r.channels)
    if (c.name == name) return c.values;
  return r.add_channel(name).values;
}

void scale(Recording& r, const std::string& name, double by) {
  for (double& v : column(r, name)) v *= by;
}

// Spoils the second of three runs and expects it, and no other, to be named so.
void expect_named(const test::Case& c, const std::function<void(Recording&)>& spoil, const std::string& words) {
  std::vector<Recording> runs = three_runs(c);
  spoil(runs[1]);
  const std::vector<std::optional<Error>> faults = faults_in(runs, c.nominal);
  EXPECT_FALSE(faults[0]) << words;
  EXPECT_FALSE(faults[2]) << words;
  ASSERT_TRUE(faults[1]) << words;
  EXPECT_EQ(faults[1]->where, "run_2.csv");
  EXPECT_NE(faults[1]->found.find(words), std::string::npos) << faults[1]->message();
  const Result<LeastSquaresCalibration> calibrated = calibrate_least_squares(runs, c.nominal);
  ASSERT_FALSE(calibrated) << words;
  EXPECT_EQ(calibrated.error().message(), faults[1]->message());
}

TEST(RecordingFault, NamesTheOneRunWhoseColumnsAreNotWhatTheyAreCalled) {
  const test::Case c = faulty_case("", 0.0, 5);
  expect_named(
      c, [](Recording& r) { scale(r, "truth_heading_rad", 180.0 / kPi); }, "degrees");
  expect_named(
      c, [](Recording& r) { scale(r, "truth_x_m", 1e3), scale(r, "truth_y_m", 1e3); }, "millimetres");
  expect_named(
      c, [](Recording& r) { std::swap(column(r, "left_wheel_rad"), column(r, "right_wheel_rad")); }, "exchanged");
  expect_named(
      c, [](Recording& r) { scale(r, "truth_y_m", -1.0); }, "mirrored");
  expect_named(
      c, [](Recording& r) { scale(r, "truth_x_m", -1.0); }, "mirrored");
  expect_named(
      c, [](Recording& r) { std::swap(column(r, "truth_x_m"), column(r, "truth_y_m")); }, "or x and y exchanged");
  expect_named(
      c, [](Recording& r) { scale(r, "right_wheel_rad", -1.0); }, "right wheel");
  expect_named(
      c, [](Recording& r) { scale(r, "left_wheel_rad", -1.0); }, "left wheel");
  expect_named(
      c, [](Recording& r) { scale(r, "left_wheel_rad", -1.0), scale(r, "right_wheel_rad", -1.0); }, "both");
  expect_named(
      c, [](Recording& r) { scale(r, "truth_heading_rad", -1.0); }, "clockwise");
  expect_named(
      c, [](Recording& r) { scale(r, "left_wheel_rad", 180.0 / kPi), scale(r, "right_wheel_rad", 180.0 / kPi); },
      "wheel_rad that look like degrees");
}

TEST(RecordingFault, NamesAnEncoderThatIsDeadAndNotAPivotAboutItsWheel) {
  const test::Case c = faulty_case("", 0.0, 5);
  expect_named(
      c, [](Recording& r) { scale(r, "left_wheel_rad", 0.0); }, "left wheel that never turns");
  Random random(3);
  const auto about_the_left_wheel = [](int) { return [](double) { return test::WheelSpeedsAt{0.0, 2.0}; }; };
  const auto nothing = [](int) { return [](test::InjectedStep&) {}; };
  const std::vector<Recording> pivots = test::three_runs(test::under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01),
                                                         random, about_the_left_wheel, nothing);
  for (const std::optional<Error>& fault : faults_in(pivots, Vehicle{})) EXPECT_FALSE(fault);
}

TEST(RecordingFault, SeesMillimetresWithoutHeadings) {
  test::Case c = faulty_case("", 0.0, 6);
  for (Recording& r : c.recordings) column(r, "truth_heading_rad").assign(r.time_s.size(), std::nan(""));
  expect_named(
      c, [](Recording& r) { scale(r, "truth_x_m", 1e3), scale(r, "truth_y_m", 1e3); }, "millimetres");
}

TEST(RecordingFault, SaysOfAllTogetherWhatAllShare) {
  const test::Case c = faulty_case("", 0.0, 7);
  std::vector<Recording> runs = three_runs(c);
  for (Recording& r : runs) std::swap(column(r, "left_wheel_rad"), column(r, "right_wheel_rad"));
  for (const std::optional<Error>& fault : faults_in(runs, c.nominal)) {
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->where, "every recording");
    EXPECT_NE(fault->found.find("exchanged"), std::string::npos) << fault->found;
  }
}

// Each effect ten times as large as the medium one, among it half of the grip lost on a patch and a radius that grows
// by 4 %, and a vehicle file that is a third off.
TEST(RecordingFault, TakesNoPhysicsForAFault) {
  for (const char* effect : {"slip_zone", "radius_drift", "lateral_slip", "turn_scrub", "collision", "magnet"}) {
    test::Case c = faulty_case(effect, 10.0, 8);
    DifferentialDrive& drive = std::get<DifferentialDrive>(c.nominal.kind);
    drive.wheel_radius_left_m *= 1.3;
    drive.wheelbase_m *= 0.7;
    for (const std::optional<Error>& fault : faults_in(c.recordings, c.nominal))
      EXPECT_FALSE(fault) << effect << ": " << (fault ? fault->message() : "");
  }
}

TEST(RecordingFault, LeavesRunsWithoutTurnsAlone) {
  test::GeneratorSettings g;
  g.truth_position_noise_m = 0.002;
  g.truth_heading_noise_rad = 0.002;
  Random random(9);
  const auto straight = [](double t) { return test::WheelSpeedsAt{4.0 * std::sin(0.3 * t), 4.0 * std::sin(0.3 * t)}; };
  Recording r = generated(g, straight, random);
  std::swap(column(r, "left_wheel_rad"), column(r, "right_wheel_rad"));  // which does no harm
  EXPECT_FALSE(fault_in(r, Vehicle{}));
}

// A quarter of a metre ahead, and between that some rounds on the spot: the little way fits its mirror image, turned by
// some angle, about as well as itself, and where a compass deviates better.
TEST(RecordingFault, LeavesTurnsOnTheSpotAloneThoughACompassDeviates) {
  constexpr double kAhead_s = 0.8;
  int refused = 0;
  for (const double deviates_rad : {0.0, 0.06})
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      test::GeneratorSettings g;
      g.duration_s = 60.0;
      Random random(seed);
      const double turning_s = random.uniform(12.0, 18.0);
      Recording r = generated(
          g,
          [&](double t) {
            const bool turns = std::fmod(t, turning_s + kAhead_s) < turning_s;
            return turns ? test::WheelSpeedsAt{-4.0, 4.0} : test::WheelSpeedsAt{4.0, 4.0};
          },
          random);
      for (double& h : column(r, "truth_heading_rad")) h += deviates_rad * std::sin(h + 0.7);
      refused += fault_in(r, Vehicle{}).has_value();
    }
  EXPECT_EQ(refused, 0) << "of 60";
}

// On a circle way and turn are the same but for a factor: which of both the truth's turn belongs to is told by nothing
// but noise.
TEST(RecordingFault, LeavesCirclesAloneHoweverNoisyTheirHeadingsAre) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::GeneratorSettings g;
    g.duration_s = 30.0;
    g.truth_period_s = 1.0 / 30.0;
    g.truth_position_noise_m = 0.002;
    g.truth_heading_noise_rad = 0.01;
    Random random(seed);
    const auto circle = [](double t) {
      const double pace = 1.0 + 0.2 * std::sin(0.5 * t);
      return test::WheelSpeedsAt{3.0 * pace, 4.0 * pace};
    };
    const Recording r = generated(g, circle, random);
    const std::optional<Error> fault = fault_in(r, Vehicle{});
    EXPECT_FALSE(fault) << seed << ": " << (fault ? fault->message() : "");
    Recording exchanged = r;
    std::swap(column(exchanged, "left_wheel_rad"), column(exchanged, "right_wheel_rad"));
    EXPECT_TRUE(fault_in(exchanged, Vehicle{})) << seed;
  }
}

// Nor is a way then told from a tracked point that sits further out: under two cameras that do not quite agree a slow
// circle had seemed a seventh as long as the wheels say, and the left wheel to roll backward.
TEST(RecordingFault, KnowsThatOneCircleDoesNotTellHowLongItsWayIs) {
  Vehicle vehicle;
  vehicle.kind = DifferentialDrive{0.122, 0.122, 0.674};
  test::GeneratorSettings g;
  g.drive = std::get<DifferentialDrive>(vehicle.kind);
  g.duration_s = 40.0;
  g.truth_period_s = 1.0 / 15.0;
  g.truth_position_noise_m = 0.007;
  g.truth_heading_noise_rad = 0.009;
  for (const bool both_ways : {false, true}) {
    Random random(3);
    const Recording r = generated(
        g,
        [&](double t) {
          return both_ways && t > 20.0 ? test::WheelSpeedsAt{1.08, 0.42} : test::WheelSpeedsAt{0.42, 1.08};
        },
        random);
    const std::optional<RunFit> fit = run_fit(r, vehicle);
    ASSERT_TRUE(fit && fit->drives);
    if (both_ways)
      EXPECT_LT(fit->way_stderr, 0.05);
    else
      EXPECT_GT(fit->way_stderr, 0.1);
    EXPECT_NEAR(fit->way_ratio, 1.0, 3.0 * fit->way_stderr);
  }
}

// One sample of a camera that saw something else is no vehicle that was carried away.
TEST(RecordingFault, IsNoDeadEncoderForOneSampleOfTheTruth) {
  for (const std::size_t wrong : {0u, 300u}) {
    Recording r;
    r.name = "rest.csv";
    for (int i = 0; i < 600; ++i) r.time_s.push_back(0.05 * i);
    for (const char* name : {"left_wheel_rad", "right_wheel_rad", "truth_x_m", "truth_y_m", "truth_heading_rad"})
      r.add_channel(name).values.assign(600, 0.0);
    column(r, "truth_x_m")[wrong] = 0.8;
    EXPECT_FALSE(fault_in(r, Vehicle{})) << wrong;
    for (std::size_t i = 400; i < 600; ++i) column(r, "truth_x_m")[i] = 0.8;  // and so is one that was
    EXPECT_TRUE(fault_in(r, Vehicle{})) << wrong;
  }
}

}  // namespace
}  // namespace odolab
