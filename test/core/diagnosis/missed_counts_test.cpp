#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kSlow_radps = 4.6, kFast_radps = 4.95, kHighest_radps = 7.6, kLimit_radps = 4.8;

// A vehicle that keeps one of two speeds, either wheel the faster one in turn, and goes at its highest for a moment.
SpeedProfile between_two_speeds(int run) {
  return [run](double t) {
    const double edge = std::min(1.0, t);
    if (t < 1.5) return WheelSpeedsAt{edge * kHighest_radps, edge * kHighest_radps};
    switch (static_cast<int>((t + 2.0 * run) / 5.0) % 4) {
      case 0:
        return WheelSpeedsAt{kSlow_radps, kFast_radps};
      case 1:
        return WheelSpeedsAt{kFast_radps, kSlow_radps};
      case 2:
        return WheelSpeedsAt{kSlow_radps, kSlow_radps};
      default:
        return WheelSpeedsAt{kFast_radps, kFast_radps};
    }
  };
}

// Twelfths of the highest speed are 4.43 and 5.07 rad/s: a grid of these steps over the gap, where alone the left
// wheel's counts are told from its radius.
TEST(EncoderMissedCounts, AreFoundByALimitBetweenTwoSpeedsThatTheVehicleKeeps) {
  Random random(92);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01);
  g.duration_s = 60.0;
  const auto missing = [](int) {
    return [](InjectedStep& s) {
      if (std::abs(s.left_radps) > kLimit_radps) s.left_read_rad *= 1.0 - 0.002;
    };
  };
  const Diagnosis d = diagnose(three_runs(g, random, between_two_speeds, missing), {}, Vehicle{}).value();
  ASSERT_FALSE(d.findings.empty());
  const Finding& f = d.findings.front();
  EXPECT_EQ(f.effect, "encoder_missed_counts");
  EXPECT_EQ(f.component, "left_wheel");
  for (const FoundParameter& p : f.parameters) {
    if (p.name == "above_radps") {
      EXPECT_GT(p.value, kSlow_radps);
      EXPECT_LT(p.value, kFast_radps);
    } else {
      EXPECT_LT(std::abs(p.value - 0.002), 3.0 * p.stderr_value);
    }
  }
}

}  // namespace
}  // namespace odolab::test
