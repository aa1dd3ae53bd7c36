#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/held_out_residuals.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

// A run whose truth is stamped 0.8 s too late.
Recording with_late_truth(std::uint64_t seed) {
  constexpr std::size_t kRows = 20;  // of 40 ms
  Recording run = linked_run(fine_clapper(), {}, seed);
  for (Channel& c : run.channels) {
    if (c.name.rfind("truth_", 0) != 0) continue;
    for (std::size_t i = c.values.size(); i-- > 0;)
      c.values[i] = i < kRows ? std::numeric_limits<double>::quiet_NaN() : c.values[i - kRows];
  }
  return run;
}

// Truck A's are its own, and B's what the link says of it.
TEST(UnitClocks, OfAllResidualsAreTheTruths) {
  const Vehicle nominal = vehicle_of(fine_clapper());
  const std::vector<Recording> fitted = {with_late_truth(1), with_late_truth(2)};
  const Recording left_out = with_late_truth(3);
  const Result<Diagnosis> d = diagnose(fitted, {}, nominal);
  ASSERT_TRUE(d) << d.error().message();
  const Diagnosis all = with_held_out_residuals_of_units(*d, fitted, {left_out}, nominal);
  ASSERT_EQ(all.residuals_before.size(), 6u);
  for (const Residuals& r : all.residuals_before) {
    EXPECT_NEAR(r.time_s.front(), 0.8, 0.1) << r.recording;
    EXPECT_NEAR(r.time_s.back(), 30.0, 0.1) << r.recording;
  }
}

}  // namespace
}  // namespace odolab::test
