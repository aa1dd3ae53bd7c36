#include "core/calibration/aligned_clock.h"

#include <gtest/gtest.h>

#include "test/support/missing_physics.h"
#include "test/support/other_clock.h"

namespace odolab::test {
namespace {

constexpr double kDuration_s = 60.0, kGrid_s = 0.01;

Case minutes_case() {
  CaseSettings c;
  c.runs = 2;
  c.duration_s = kDuration_s;
  return generated_case(c, 8211);
}

InnovationModel model_of(const Case& c) { return {c.actual, c.nominal.truth, {0.001, 0.001, 0.002}}; }

TEST(AlignedClock, FindsHowLateATruthIsAndHowMuchFasterTheWheelsClockRuns) {
  const Case c = minutes_case();
  struct Clock {
    double offset_s, rate;
  };
  for (const Clock& actual : {Clock{0.23, 0.0}, Clock{-0.12, -0.003}, Clock{0.05, 0.004}, Clock{-0.4, 0.002}})
    for (const Recording& r : c.recordings) {
      const auto run = innovation_run(with_truths_clock(r, actual.offset_s, actual.rate), c.nominal);
      ASSERT_TRUE(run);
      const std::optional<AlignedClock> found = aligned_clock(*run, model_of(c));
      ASSERT_TRUE(found);
      // The lag at each end is one of a grid, and a window's is taken as constant: two steps of the grid.
      EXPECT_NEAR(found->offset_s, actual.offset_s, 2.0 * kGrid_s);
      EXPECT_NEAR(found->rate, actual.rate, 2.0 * kGrid_s / kDuration_s * 2.0);
    }
}

TEST(AlignedClock, GainsNothingWhereTheClocksAgree) {
  const Case c = minutes_case();
  for (const Recording& r : c.recordings) {
    const auto run = innovation_run(r, c.nominal);
    ASSERT_TRUE(run);
    const std::optional<AlignedClock> found = aligned_clock(*run, model_of(c));
    ASSERT_TRUE(found);
    // The best of ten thousand pairs of lags gains by chance what chi-square of two numbers exceeds once in as
    // many: 18.
    EXPECT_LT(found->gain, 18.0);
  }
}

TEST(AlignedClock, IsNotSoughtWithoutHeadings) {
  CaseSettings settings;
  settings.runs = 1;
  settings.duration_s = 30.0;
  settings.truth = CaseSettings::Truth::coarse_without_heading;
  const Case c = generated_case(settings, 8212);
  const auto run = innovation_run(c.recordings[0], c.nominal);
  ASSERT_TRUE(run);
  EXPECT_FALSE(aligned_clock(*run, model_of(c)));
}

}  // namespace
}  // namespace odolab::test
