#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kPushed_s = 32.1;

// Four runs of a cart that something shoves aside by 8 cm in the third, under a camera that sees it three times a
// second.
std::vector<Recording> pushed_under_a_slow_camera(std::uint64_t seed) {
  Random random(seed);
  GeneratorSettings g;
  g.drive = {0.126, 0.126, 1.0876};
  g.wheel_noise = 0.0008;
  g.truth_period_s = 0.338;
  g.truth_has_heading = false;
  g.truth_position_noise_m = 0.014;
  g.duration_s = 60.0;
  std::vector<Recording> recordings;
  for (int run = 0; run < 4; ++run) {
    g.inject = [=](InjectedStep& s) {
      if (run != 2 || std::abs(s.time_s - kPushed_s) > 0.075) return;
      const double share = s.dt_s / 0.15;
      s.room_m = s.room_m + share * Vec2{-0.05, -0.064};
      s.turn_rad -= share * 0.026;
    };
    recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
    recordings.back().name = "run_" + std::to_string(run + 1);
  }
  return recordings;
}

// Of samples that contradict what was there before, the first are taken for glitches, and a push was said where these
// end: in one program's recordings half a second late, to a twentieth.
TEST(Collision, HappenedBeforeTheFirstSampleThatSawIt) {
  for (const std::uint64_t seed : {11u, 12u, 13u, 14u}) {
    Vehicle nominal;
    nominal.kind = DifferentialDrive{0.127, 0.127, 1.05};
    const Diagnosis d = diagnose(pushed_under_a_slow_camera(seed), {}, nominal).value();
    ASSERT_FALSE(d.findings.empty()) << seed;
    const Finding& f = d.findings.front();
    ASSERT_EQ(f.effect, "collision") << seed;
    EXPECT_EQ(f.where.recording, "run_3");
    const FoundParameter& at = f.parameters.back();
    ASSERT_EQ(at.name, "at_s");
    EXPECT_NEAR(at.value, kPushed_s, 0.338) << seed;  // from one sample to the next
    EXPECT_LT(std::abs(at.value - kPushed_s), 4.0 * at.stderr_value) << seed;
  }
}

}  // namespace
}  // namespace odolab::test
