#include "core/diagnosis/measurement_findings.h"

#include <gtest/gtest.h>

#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

std::vector<Recording> three_runs_of(const TruthMounting& truth) {
  Random random(71);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0005, 0.01);
  g.truth = truth;
  g.duration_s = 45.0;
  return three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); },
      [](int) -> std::function<void(InjectedStep&)> { return {}; });
}

TEST(MeasurementFindings, SayAMarkerThatSitsAMillimetreElsewhere) {
  TruthMounting truth;
  truth.axle_T_tracked = {0.0008, -0.0006, 0.0};
  const Diagnosis d = diagnose(three_runs_of(truth), {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "truth_mounting_offset");
  EXPECT_TRUE(d.findings[0].alternatives.empty());  // no axle shifts a marker
  const FoundParameter &x = d.findings[0].parameters[0], &y = d.findings[0].parameters[1];
  EXPECT_NEAR(x.value, 0.0008, 4.0 * x.stderr_value);
  EXPECT_NEAR(y.value, -0.0006, 4.0 * y.stderr_value);
}

// A hand that turned it has shifted it; where it sits to the tenth of a millimetre an axle may be at fault as well, but
// none is crooked by 2.6 degrees.
TEST(MeasurementFindings, SayOfAMarkerThatIsTurnedWhatElseMayBe) {
  struct {
    double shifted_m, turned_rad;
    bool is_marker_first;
  } const cases[] = {{0.0, 0.004, false}, {0.001, 0.004, true}, {0.0, 0.045, true}};
  for (const auto& [shifted_m, turned_rad, is_marker_first] : cases) {
    TruthMounting truth;
    truth.axle_T_tracked = {shifted_m, -shifted_m, turned_rad};
    const Diagnosis d = diagnose(three_runs_of(truth), {}, Vehicle{}).value();
    ASSERT_EQ(d.findings.size(), 1u);
    EXPECT_EQ(d.findings[0].effect, is_marker_first ? "truth_mounting_offset" : "wheel_toe");
    ASSERT_EQ(d.findings[0].alternatives.size(), 1u);
    EXPECT_EQ(d.findings[0].alternatives[0].effect, is_marker_first ? "wheel_toe" : "truth_mounting_offset");
  }
}

// A toe that may be no more than how the marker sits is less sure than any other name, however plainly it shows.
TEST(MeasurementFindings, ComeAfterNamesWhereTheyMayBeAMarkers) {
  Finding toe, slip;
  toe.effect = "wheel_toe";
  toe.log_likelihood_gain = 7000.0;
  slip.effect = "lateral_slip";
  slip.log_likelihood_gain = 1000.0;
  EXPECT_TRUE(comes_first(toe, slip));
  toe.alternatives.push_back({"truth_mounting_offset", "truth", 7000.0, ""});
  EXPECT_TRUE(comes_first(slip, toe));
  EXPECT_FALSE(comes_first(toe, slip));
}

// A marker that is put on four millimetres away is turned by some hundredths of a radian, and no more. Of less an axle
// is no rival, being a second cause, but it is said that it would look the same as far as axles go, 20 mrad.
TEST(MeasurementFindings, SayThatAnAxleMayBeAtFaultWhereAMarkerIsTurnedByMoreThanItIsShifted) {
  struct {
    double shifted_m, turned_rad;
    bool is_rival, is_mentioned;
  } const cases[] = {
      {0.003, 0.004, false, true}, {0.003, 0.05, true, false}, {0.02, 0.01, false, true}, {0.005, 0.03, false, false}};
  for (const auto& [shifted_m, turned_rad, is_rival, is_mentioned] : cases) {
    TruthMounting truth;
    truth.axle_T_tracked = {shifted_m, -shifted_m, turned_rad};
    const Diagnosis d = diagnose(three_runs_of(truth), {}, Vehicle{}).value();
    ASSERT_EQ(d.findings.size(), 1u);
    EXPECT_EQ(d.findings[0].effect, "truth_mounting_offset");
    ASSERT_EQ(d.findings[0].alternatives.size(), is_rival ? 1u : 0u);
    for (const Alternative& other : d.findings[0].alternatives) EXPECT_EQ(other.effect, "wheel_toe");
    EXPECT_EQ(d.findings[0].sentence.find("axle") != std::string::npos, is_mentioned) << d.findings[0].sentence;
  }
}

TEST(MeasurementFindings, SayATruthThatIsThreeMillisecondsLate) {
  TruthMounting truth;
  truth.time_offset_s = 0.003;
  const Diagnosis d = diagnose(three_runs_of(truth), {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "truth_time_offset");
  EXPECT_NEAR(d.findings[0].parameters[0].value, 0.003, 4.0 * d.findings[0].parameters[0].stderr_value);
}

TEST(MeasurementFindings, SayNothingOfWhatIsWhereTheFileHasIt) {
  EXPECT_EQ(diagnose(three_runs_of({}), {}, Vehicle{}).value().verdict, Verdict::nothing_missing);
}

}  // namespace
}  // namespace odolab::test
