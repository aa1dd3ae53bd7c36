#include "core/diagnosis/generic/stretches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Runs of 80 s under a camera, on a floor that turns the base by 0.7 degrees over a metre; of the second, someone
// leans on the left wheel from 30 to 44 s, so that it rolls shorter by such a share.
std::vector<Recording> leaned_on(std::uint64_t seed, double share) {
  Random random(seed);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.003, 0.01);
  g.duration_s = 80.0;
  g.truth_position_noise_m = 0.004;
  g.truth_heading_noise_rad = 0.006;
  const auto leaning = [&](int run) {
    return [=](InjectedStep& s) {
      if (run == 1 && s.time_s > 30.0 && s.time_s < 44.0) s.left_m *= 1.0 - share;
    };
  };
  return three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); }, leaning);
}

TEST(Stretches, InWhichSomeoneLeansOnAWheelAreSaidAndLeftOut) {
  int left_out = 0;
  for (std::uint64_t seed = 51; seed < 54; ++seed) {
    const Result<Diagnosis> d = diagnose(leaned_on(seed, 0.02), {}, Vehicle{});
    ASSERT_TRUE(d);
    EXPECT_EQ(d->verdict, Verdict::unknown_effect) << seed;
    const Finding& f = d->findings.front();
    EXPECT_EQ(f.effect, "unknown") << seed;
    if (!f.is_parted) continue;  // it may look like a patch that turns it by its heading: without a name as well
    ++left_out;
    EXPECT_EQ(f.where.recording, "run_2") << seed;
    ASSERT_EQ(f.where.time_s.size(), 1u) << seed;
    // Its first and last seconds may lie within noise.
    EXPECT_NEAR(f.where.time_s.front().first, 30.0, 3.0) << seed;
    EXPECT_NEAR(f.where.time_s.front().second, 44.0, 3.0) << seed;
  }
  EXPECT_GE(left_out, 2);
}

TEST(Stretches, AreNoneWhereNothingIsMissing) {
  for (std::uint64_t seed = 61; seed < 66; ++seed) {
    const Result<Diagnosis> d = diagnose(leaned_on(seed, 0.0), {}, Vehicle{});
    ASSERT_TRUE(d);
    EXPECT_EQ(d->verdict, Verdict::nothing_missing) << seed;
  }
}

}  // namespace
}  // namespace odolab::test
