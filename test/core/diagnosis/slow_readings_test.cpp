#include <gtest/gtest.h>

#include <functional>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"
#include "test/support/short_cases.h"

namespace odolab::test {
namespace {

// Encoders that are read five times a second, and motion capture that sees a hundred times what the wheels do
// meanwhile: where these speed up, that nobody knows. Of eight such robots each had an effect in no list.
TEST(SlowReadings, MakeNothingUpWhereNothingIsMissing) {
  for (std::uint64_t seed = 43; seed < 49; ++seed) {
    Random random(seed);
    GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 3e-4, 0.01, 0.0003, 0.001);
    g.duration_s = 40.0;
    g.wheel_period_s = 0.2;
    const Diagnosis d = diagnose(three_runs(
                                     g, random, [&](int) { return varied_driving(random, g.duration_s); },
                                     [](int) { return std::function<void(InjectedStep&)>(); }),
                                 {}, Vehicle{})
                            .value();
    EXPECT_EQ(d.verdict, Verdict::nothing_missing) << seed << ": " << said(d);
  }
}

}  // namespace
}  // namespace odolab::test
