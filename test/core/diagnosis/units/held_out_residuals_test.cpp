#include "core/diagnosis/units/held_out_residuals.h"

#include <gtest/gtest.h>

#include "core/diagnosis/mismatch.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / double(values.size());
}

TEST(HeldOutResiduals, OfATrailerAreNoiseOnceTheWheelThatErrsIsKnown) {
  LinkedRunSettings s;
  s.b_left = [](double, double, double by_rad) { return std::abs(by_rad) > 0.03 ? -0.04 * by_rad : 0.0; };  // 3 rad/s
  std::vector<Recording> fitted;
  for (const std::uint64_t seed : {51, 52, 53}) fitted.push_back(trailer_run(EncoderTrailer{}, s, seed));
  Recording left_out = trailer_run(EncoderTrailer{}, s, 61);
  left_out.name = "left out.csv";
  Vehicle nominal;
  nominal.kind = EncoderTrailer{};
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
