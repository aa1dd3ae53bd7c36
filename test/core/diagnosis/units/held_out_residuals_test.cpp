#include "core/diagnosis/units/held_out_residuals.h"

#include <gtest/gtest.h>

#include "core/diagnosis/mismatch.h"
#include "test/support/miscounting_runs.h"

namespace odolab::test {
namespace {

TEST(HeldOutResiduals, OfATrailerAreNoiseOnceTheWheelThatErrsIsKnown) {
  const auto [nominal, fitted, left_out] = miscounting_runs(EncoderTrailer{}, trailer_run, 0.04);
  const Result<Diagnosis> d = diagnose(fitted, {}, nominal);
  ASSERT_TRUE(d.ok());
  ASSERT_FALSE(d->findings.empty());
  const Diagnosis drawn = with_held_out_residuals_of_units(*d, fitted, {left_out}, nominal);
  const MismatchOverTime m = mismatch_over_time(drawn, "left out.csv");
  ASSERT_FALSE(m.time_s.empty());
  // Of noise alone the larger of two gathered sizes is a little above 1; as much as in the runs that were fitted.
  const MismatchOverTime of_fitted = mismatch_over_time(drawn, fitted[0].name);
  EXPECT_NEAR(mean(m.after), mean(of_fitted.after), 0.3);
  EXPECT_GT(mean(m.before), 1.3 * mean(m.after));
}

}  // namespace
}  // namespace odolab::test
