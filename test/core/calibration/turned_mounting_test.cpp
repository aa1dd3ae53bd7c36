#include "core/calibration/turned_mounting.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/calibration/least_squares.h"
#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

std::vector<Recording> with_headings_turned(const Case& c, double by_rad) {
  std::vector<Recording> recordings = c.recordings;
  for (Recording& r : recordings)
    for (Channel& channel : r.channels)
      if (channel.name == "truth_heading_rad")
        for (double& v : channel.values) v = wrapped(v + by_rad);
  return recordings;
}

Case three_runs_of_it() {
  CaseSettings settings;
  settings.runs = 3;
  settings.duration_s = 40.0;
  return generated_case(settings, 9107);
}

// A quarter of a turn was said to be the wrong sign of a wheel, and the right angle in the vehicle's file was no cure.
TEST(TurnedMounting, ByAnyAngleIsFoundAsItIs) {
  const Case c = three_runs_of_it();
  for (const double turned_rad : {-2.8, -1.6, 1.3, 0.5 * kPi, kPi}) {
    const std::vector<Recording> recordings = with_headings_turned(c, turned_rad);
    for (const bool is_known : {false, true}) {
      Vehicle nominal = c.nominal;
      if (is_known) nominal.truth.axle_T_tracked.heading_rad = turned_rad;
      const Result<LeastSquaresCalibration> fit = calibrate_least_squares(recordings, nominal);
      ASSERT_TRUE(fit) << turned_rad << ": " << fit.error().message();
      for (const ParameterEstimate& p : fit->parameters)
        if (p.name == "truth_mounting.heading_rad") {
          EXPECT_NEAR(wrapped(p.value - turned_rad), 0.0, 4.0 * p.stderr_value) << turned_rad;
          EXPECT_EQ(p.nominal, nominal.truth.axle_T_tracked.heading_rad);
        }
      EXPECT_NEAR(std::get<DifferentialDrive>(fit->vehicle.kind).wheelbase_m, c.actual.wheelbase_m, 1e-3);
    }
  }
}

// One in the middle and one to either side: whether they are alike had been asked of the first alone.
TEST(TurnedMounting, IsFoundInWhateverOrderTheRunsCome) {
  const Case c = three_runs_of_it();
  std::vector<Recording> runs;
  for (const double turned_rad : {1.35, 1.5, 1.65}) runs.push_back(with_headings_turned(c, turned_rad)[runs.size()]);
  for (int first = 0; first < 3; ++first) {
    EXPECT_NEAR(turned_as_driven(runs, c.nominal).truth.axle_T_tracked.heading_rad, 1.5, 0.02);
    std::rotate(runs.begin(), runs.begin() + 1, runs.end());
  }
}

// Of seven runs one on few arcs had it half a radian elsewhere, and all were refused as wheels that roll backward. Of
// two that differ neither is believed.
TEST(TurnedMounting, IsFoundBesideARunThatHasItElsewhere) {
  const Case c = three_runs_of_it();
  std::vector<Recording> runs;
  for (const double turned_rad : {1.5, 1.0, 1.5}) runs.push_back(with_headings_turned(c, turned_rad)[runs.size()]);
  EXPECT_NEAR(turned_as_driven(runs, c.nominal).truth.axle_T_tracked.heading_rad, 1.5, 0.02);
  runs.pop_back();
  EXPECT_EQ(turned_as_driven(runs, c.nominal).truth.axle_T_tracked.heading_rad,
            c.nominal.truth.axle_T_tracked.heading_rad);
}

// One that is too short to say anything was taken for one that is measured at its ends alone, of which one is too few.
TEST(TurnedMounting, IsFoundBesideARunThatIsTooShort) {
  const Case c = three_runs_of_it();
  std::vector<Recording> runs = with_headings_turned(c, -2.75);
  Recording brief = runs.front();
  constexpr double kBrief_s = 6.0;
  const std::size_t rows = static_cast<std::size_t>(
      std::lower_bound(brief.time_s.begin(), brief.time_s.end(), brief.time_s.front() + kBrief_s) -
      brief.time_s.begin());
  brief.time_s.resize(rows);
  for (Channel& channel : brief.channels) channel.values.resize(rows);
  runs.push_back(brief);
  EXPECT_NEAR(turned_as_driven(runs, c.nominal).truth.axle_T_tracked.heading_rad, -2.75, 0.02);
}

// On one circle a point that is turned is nearly one that sits elsewhere: such runs say a quarter of a turn more or
// less, and know it, and those that drive eights know better.
TEST(TurnedMounting, IsFoundByThoseThatKnowItBest) {
  constexpr double kTurned_rad = 1.4, kSpeed_radps = 4.0;
  Random random(311);
  GeneratorSettings g = under_motion_capture({0.035, 0.035, 0.26}, 0.0003, 0.04);
  g.truth_position_noise_m = 0.008;
  g.duration_s = 20.0;
  std::vector<Recording> runs;
  for (int run = 0; run < 8; ++run) {
    const bool is_eight = run == 3;
    runs.push_back(generated(
        g,
        [&](double t) {
          const double turn = is_eight && std::fmod(t, 8.0) < 4.0 ? -1.5 : 1.5;
          return WheelSpeedsAt{kSpeed_radps - turn, kSpeed_radps + turn};
        },
        random));
    for (Channel& channel : runs.back().channels)
      if (channel.name == "truth_heading_rad")
        for (double& v : channel.values) v = wrapped(v + kTurned_rad);
  }
  Vehicle file;
  file.kind = DifferentialDrive{0.035, 0.035, 0.26};
  EXPECT_NEAR(turned_as_driven(runs, file).truth.axle_T_tracked.heading_rad, kTurned_rad, 0.2);
}

// One circle and nothing else: whether a point is turned or sits elsewhere it knows to a radian and more, and a marker
// that sat on the axle was turned by 3 rad, and then 0.68 m beside it, beyond doubt.
TEST(TurnedMounting, StaysAsTheFileSaysWhereNoRunKnowsIt) {
  Vehicle file;
  file.kind = DifferentialDrive{0.035, 0.035, 0.26};
  for (const double noise_m : {0.002, 0.008, 0.02})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Random random(seed);
      GeneratorSettings g = under_motion_capture({0.035, 0.035, 0.26}, 0.0003, 0.04);
      g.truth_position_noise_m = noise_m;
      g.duration_s = 20.0;
      const Recording circle = generated(
          g,
          [](double) {
            return WheelSpeedsAt{2.5, 5.5};
          },
          random);
      EXPECT_EQ(turned_as_driven({circle}, file).truth.axle_T_tracked.heading_rad, 0.0) << noise_m << " " << seed;
    }
}

// Measured by tape before and after each run: where it came to, against how it stood, is enough.
TEST(TurnedMounting, IsFoundByPosesAtBothEndsAlone) {
  CaseSettings settings;
  settings.truth = CaseSettings::Truth::ends;
  settings.runs = 6;
  settings.duration_s = 25.0;
  const Case c = generated_case(settings, 9108);
  constexpr double kTurned_rad = -2.8;
  const std::vector<Recording> recordings = with_headings_turned(c, kTurned_rad);
  EXPECT_NEAR(turned_as_driven(recordings, c.nominal).truth.axle_T_tracked.heading_rad, kTurned_rad, 0.2);
  const Result<Diagnosis> d = diagnose(recordings, {}, c.nominal);
  ASSERT_TRUE(d) << d.error().message();
  EXPECT_NE(d->verdict, Verdict::unknown_effect) << d->findings.front().where.regime;
}

TEST(TurnedMounting, IsSaidAndNothingElse) {
  const Case c = three_runs_of_it();
  const Result<Diagnosis> d = diagnose(with_headings_turned(c, 2.0), {}, c.nominal);
  ASSERT_TRUE(d) << d.error().message();
  ASSERT_EQ(d->findings.size(), 1u);
  EXPECT_EQ(d->findings[0].effect, "truth_mounting_offset");
  for (const FoundParameter& p : d->findings[0].parameters)
    if (p.name == "heading_rad") {
      EXPECT_NEAR(p.value, 2.0, 4.0 * p.stderr_value);
    }
}

TEST(TurnedMounting, StaysAsTheFileSaysWhereAFitFindsItByItself) {
  const Case c = three_runs_of_it();
  for (const double turned_rad : {0.0, 0.3, -0.8})
    EXPECT_EQ(turned_as_driven(with_headings_turned(c, turned_rad), c.nominal).truth.axle_T_tracked.heading_rad,
              c.nominal.truth.axle_T_tracked.heading_rad);
}

}  // namespace
}  // namespace odolab::test
