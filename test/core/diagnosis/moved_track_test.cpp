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
