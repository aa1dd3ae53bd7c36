#include <gtest/gtest.h>

#include <algorithm>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// What is left of a patch on which a fifth of the way is lost shows on that patch: a tyre that is squeezed in every
// bend is no trace of it, though it says less than a hundredth of what the patch says.
TEST(SecondCause, IsNoTraceOfAFarStrongerOneThatActsElsewhere) {
  for (const std::uint64_t seed : {41u, 42u}) {
    Random random(seed);
    GeneratorSettings g;
    g.drive = {0.0752, 0.0747, 0.343};
    g.duration_s = 60.0;
    g.wheel_noise = 0.0003;
    g.truth_period_s = 0.02;
    g.truth_position_noise_m = 0.0005;
    g.truth_heading_noise_rad = 0.001;
    std::vector<Recording> recordings;
    for (int run = 0; run < 4; ++run) {
      const auto slips = injected("slip_zone", 4.0, g.drive, run, g.duration_s, random),
                 squeezed = injected("tyre_compression", 4.0, g.drive, run, g.duration_s, random);
      g.inject = [=](InjectedStep& s) {
        squeezed(s);
        slips(s);
      };
      recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
      recordings.back().name = "run_" + std::to_string(run + 1);
    }
    const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
    ASSERT_EQ(d.findings.size(), 2u) << seed;
    EXPECT_EQ(d.findings[0].effect, "slip_zone") << seed;
    EXPECT_EQ(d.findings[1].effect, "tyre_compression") << seed;
    EXPECT_LT(d.findings[1].log_likelihood_gain, 0.01 * d.findings[0].log_likelihood_gain) << seed;
    EXPECT_NEAR(d.findings[1].parameters.front().value, 2e-3, 3.0 * d.findings[1].parameters.front().stderr_value)
        << seed;
  }
}

}  // namespace
}  // namespace odolab::test
