#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/odometry/prediction.h"
#include "test/support/short_cases.h"

namespace odolab::test {
namespace {

TEST(Diagnose, FindsNothingWhereNothingIsMissingWhateverTheNoiseAndWhereverCalibrationStarted) {
  // 3 % is the bar; 14 cases with at most one alarm are passed by a tool that holds it in 94 % of seeds, and these
  // seeds are fixed.
  int alarms = 0;
  std::string what;
  for (int k = 0; k < 14; ++k) {
    const Diagnosis d = diagnosed(generated_case(short_case("", 0.0), 7000 + static_cast<std::uint64_t>(k)));
    if (d.verdict == Verdict::nothing_missing || d.verdict == Verdict::cannot_say) continue;
    ++alarms;
    what += "seed " + std::to_string(7000 + k) + ": " + said(d) + "; ";
  }
  EXPECT_LE(alarms, 1) << what;
}

TEST(Diagnose, TakesATrackerThatLosesItselfForAMomentAndComesBackForNoPush) {
  Case c = generated_case(short_case("", 0.0), 7061);
  for (Recording& r : c.recordings)
    change_truth(r, [](std::size_t k, double& x, double& y, double& heading) {
      if (k % 700 < 400 || k % 700 >= 408) return;  // eight samples in a row
      x += 0.5, y -= 0.3, heading += 0.4;
    });
  const Diagnosis d = diagnosed(c);
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
}

// From one marker: each window of a metre begins with the heading that the way before it shows.
TEST(Diagnose, ProvesByTheWayAloneWhereTheTruthHasNoHeadings) {
  Case c = generated_case(short_case("one_sided_drag", 8.0), 7069);
  for (Recording& r : c.recordings)
    change_truth(
        r, [](std::size_t, double&, double&, double& heading) { heading = std::numeric_limits<double>::quiet_NaN(); });
  const Diagnosis d = diagnosed(c);
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  ASSERT_TRUE(d.held_out.calibrated && d.held_out.with_findings && d.held_out.noise_floor);
  const FitFigures &before = *d.held_out.calibrated, &after = *d.held_out.with_findings;
  ASSERT_TRUE(before.gathered());
  EXPECT_FALSE(before.has_heading());
  // A heading that is off by 0.08 at the end of a metre has led 40 mm aside, of which calibration takes what goes one
  // way; what is left is noise, to within the chance of some 80 windows.
  EXPECT_GT(before.position_rms_m, 0.010);
  EXPECT_LT(after.position_rms_m, 0.8 * before.position_rms_m);
  EXPECT_LT(after.position_rms_m, 1.25 * d.held_out.noise_floor->position_rms_m);
}

// As of localisation in a map: it is matched anew each time it is far enough off.
void let_truth_jump(Case& c, std::uint64_t seed) {
  constexpr std::size_t kSamples = 240;  // from one jump to the next, 4 s
  constexpr double kBy_m = 0.008, kBy_rad = 0.005;
  Random random(seed);
  for (Recording& r : c.recordings) {
    double dx = 0.0, dy = 0.0, dheading = 0.0;
    change_truth(r, [&](std::size_t k, double& x, double& y, double& heading) {
      if (k % kSamples == kSamples / 2)
        dx = kBy_m * random.normal(), dy = kBy_m * random.normal(), dheading = kBy_rad * random.normal();
      x += dx, y += dy, heading += dheading;
    });
  }
}

TEST(Diagnose, TakesATruthThatJumpsTimeAndAgainForNoPushes) {
  Case c = generated_case(short_case("", 0.0), 7064);
  let_truth_jump(c, 7065);
  const Diagnosis d = diagnosed(c);
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(),
                          [](const std::string& w) { return w.find("the truth jumps at ") == 0; }));
}

TEST(Diagnose, NamesWhatIsMissingUnderATruthThatJumps) {
  Case c = generated_case(short_case("one_sided_drag", 1.0), 7066);
  let_truth_jump(c, 7067);
  const Diagnosis d = diagnosed(c);
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "one_sided_drag");
}

TEST(Diagnose, TakesNothingForAnEffectWhereThereIsNoNoiseAtAll) {
  // Only the path between two readings is left, some hundredths of a millimetre.
  CaseSettings c = short_case("", 0.0);
  c.without_noise = true;
  const Diagnosis d = diagnosed(generated_case(c, 7050));
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
}

TEST(Diagnose, NamesAnEffectAloneWhereThereIsNoNoiseAtAll) {
  CaseSettings c = short_case("lateral_slip", 1.0);
  c.without_noise = true;
  const Diagnosis d = diagnosed(generated_case(c, 7051));
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings.front().effect, "lateral_slip");
}

class NamesEffect : public testing::TestWithParam<const char*> {};

TEST_P(NamesEffect, FirstWhereItIsStrong) {
  // Compressed tyres hide in the wheelbase on a drive this short and slow.
  const double size = std::string(GetParam()) == "tyre_compression" ? 10.0 : 3.0;
  const Diagnosis d = diagnosed(generated_case(short_case(GetParam(), size), 7100));
  ASSERT_FALSE(d.findings.empty()) << static_cast<int>(d.verdict);
  EXPECT_EQ(d.findings.front().effect, GetParam()) << said(d);
  // What was named must make the recordings themselves better predicted.
  ASSERT_TRUE(d.train.calibrated && d.train.with_findings);
  EXPECT_LE(d.train.with_findings->normalised_chi2, 1.01 * d.train.calibrated->normalised_chi2);
}
INSTANTIATE_TEST_SUITE_P(Catalogue, NamesEffect,
                         testing::Values("wheel_eccentricity", "encoder_missed_counts", "drivetrain_backlash",
                                         "castor_reversal_kick", "radius_drift", "tyre_compression",
                                         "speed_dependent_radius", "payload_radius_change", "lateral_slip",
                                         "traction_slip", "turn_scrub", "one_sided_drag", "bump", "slip_zone",
                                         "floor_slope_creep", "collision", "turn_speed_loss", "wheel_toe"),
                         [](const testing::TestParamInfo<const char*>& p) { return std::string(p.param); });

TEST(Diagnose, MeasuresAnEffectToWithinItsUncertainty) {
  const Diagnosis d = diagnosed(generated_case(short_case("lateral_slip", 1.0), 7201));
  ASSERT_FALSE(d.findings.empty());
  ASSERT_EQ(d.findings.front().effect, "lateral_slip");
  const FoundParameter& p = d.findings.front().parameters.front();
  EXPECT_NEAR(p.value, 0.02, 4.0 * p.stderr_value + 0.0004);  // and 2 % for the form's own error
}

TEST(Diagnose, CallsUnknownWhatIsInNoList) {
  for (const char* outside :
       {"magnet", "compass", "memory", "waves", "gusts", "wheelbase_with_time", "uneven_castor"}) {
    const Diagnosis d = diagnosed(generated_case(short_case(outside, 2.0), 7301));
    EXPECT_EQ(d.verdict, Verdict::unknown_effect) << outside << ": " << said(d);
    // Names that are not said leave no trace in the model.
    ASSERT_TRUE(d.fitted_vehicle);
    EXPECT_EQ(std::get<DifferentialDrive>(d.fitted_vehicle->kind).wheelbase_m,
              std::get<DifferentialDrive>(d.calibration_alone.vehicle.kind).wheelbase_m)
        << outside;
  }
}

TEST(Diagnose, CallsManyPushesAndNoOtherCauseUnknown) {
  Random random(7311);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 40.0;
  const auto pushed = [](int run) {
    return [run](InjectedStep& s) {
      for (const double at_s : {8.0, 19.0, 31.0})
        if (run == 1 && s.time_s >= at_s && s.time_s < at_s + 0.05) s.sideways_m += 0.3 * s.dt_s;  // 15 mm each
    };
  };
  const std::vector<Recording> recordings = three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); }, pushed);
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  EXPECT_EQ(d.verdict, Verdict::unknown_effect) << said(d);
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().alternatives.size(), 3u);
}

TEST(Diagnose, SaysOfWhichWheelTheRadiusDependsOnSpeed) {
  Random random(7321);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 50.0;
  const auto growing = [](InjectedStep& s) { s.right_m *= 1.0 + 0.02 * std::abs(0.075 * s.right_radps); };
  const std::vector<Recording> recordings = three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); }, [&](int) { return growing; });
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "speed_dependent_radius");
  EXPECT_EQ(d.findings[0].component, "right_wheel");
  const FoundParameter& p = d.findings[0].parameters.front();
  EXPECT_NEAR(p.value, 0.02, 4.0 * p.stderr_value);
}

// However much a marker that sits elsewhere explains, calibration does without a name.
TEST(Diagnose, SaysWhatCalibrationLeavesBeforeWhereTheTrackedPointSits) {
  Case c = generated_case(short_case("lateral_slip", 2.0), 7402);
  for (Recording& r : c.recordings)
    change_truth(r, [](std::size_t, double& x, double& y, double& heading) {
      x += 0.03 * std::cos(heading), y += 0.03 * std::sin(heading), heading += 0.2;
    });
  const Diagnosis d = diagnosed(c);
  ASSERT_EQ(d.findings.size(), 2u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "lateral_slip");
  EXPECT_EQ(d.findings[1].effect, "truth_mounting_offset");
  EXPECT_GT(d.findings[1].log_likelihood_gain, d.findings[0].log_likelihood_gain);
}

TEST(Diagnose, SaysThatItCannotSayWhereTheTruthIsOnlyStartAndEnd) {
  CaseSettings c = short_case("lateral_slip", 3.0);
  c.truth = CaseSettings::Truth::ends;
  EXPECT_EQ(diagnosed(generated_case(c, 7401)).verdict, Verdict::cannot_say);
}

TEST(PredictedTrack, WithoutEffectsIsTheVehiclesOwn) {
  const Case c = generated_case(short_case("", 0.0), 7701);
  const Result<Track> a = predicted_track(c.recordings[0], c.nominal),
                      b = predicted_track(c.recordings[0], c.nominal,
                                          {{"wheel_toe", "vehicle", {{"sideways_per_metre", 0.0}}}});
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->size(), b->size());
  // Two ways through the same arithmetic: rounding only.
  EXPECT_NEAR(a->back().pose.x_m, b->back().pose.x_m, 1e-9);
  EXPECT_NEAR(a->back().pose.heading_rad, b->back().pose.heading_rad, 1e-9);
}

}  // namespace
}  // namespace odolab::test
