#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/pushed_runs.h"

namespace odolab::test {
namespace {

TEST(MovedTrack, IsMovedByAPushAsFarAsThatPushes) {
  constexpr double kPush_m = 0.03;
  const Diagnosis d = diagnose(runs_with_a_push(kPush_m, 17.0), {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  const Finding& f = d.findings.front();
  ASSERT_EQ(f.effect, "collision");
  ASSERT_TRUE(f.moves.has_value());
  // Four standard errors of a push that is one stretch's alone, whatever the hundred other stretches are.
  EXPECT_NEAR(f.moves->position_rms_m, kPush_m, 4.0 * f.parameters[0].stderr_value);
  EXPECT_LT(f.moves->heading_rms_rad, 4.0 * f.parameters[2].stderr_value);
}

// Turned towards a direction of the room, which no name describes: what it moves is what calibration leaves beyond
// noise (squares add up).
TEST(MovedTrack, OfWhatHasNoNameIsAsMuchAsCalibrationLeavesOfIt) {
  CaseSettings settings;
  settings.effect = "compass";
  settings.size = 4.0;
  settings.runs = 3;
  settings.duration_s = 50.0;
  const Case c = generated_case(settings, 4);
  const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  ASSERT_TRUE(d.findings.front().moves.has_value());
  ASSERT_TRUE(d.train.calibrated && d.train.noise_floor);
  const double left_rad =
      std::sqrt(std::pow(d.train.calibrated->heading_rms_rad, 2) - std::pow(d.train.noise_floor->heading_rms_rad, 2));
  // It does nothing on the spot and at rest, which is a third of the stretches at most: 1.22 times as much in the
  // others.
  const double moves_rad = d.findings.front().moves->heading_rms_rad;
  EXPECT_GT(moves_rad, left_rad);
  EXPECT_LT(moves_rad, 1.22 * left_rad);
}

TEST(MovedTrack, IsOfTheMotionAlone) {
  // The truth's clock is late; a robot that is not seen in time is not moved.
  CaseSettings settings;
  settings.duration_s = 30.0;
  settings.truth_late_s = 0.08;
  const Case c = generated_case(settings, 5);
  const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
  ASSERT_FALSE(d.findings.empty());
  for (const Finding& f : d.findings) EXPECT_FALSE(f.moves.has_value()) << f.effect;
}

}  // namespace
}  // namespace odolab::test
