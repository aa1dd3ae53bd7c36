#include "core/diagnosis/generic/told_speeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/diagnosis/diagnosis.h"
#include "test/support/commanded_base.h"

namespace odolab {
namespace {

// A stick that is pushed to somewhere else every second and a half, and let back now and then by a little.
std::vector<Recording> driven_by_stick(const std::function<void(test::CommandedBase&)>& obeys) {
  std::vector<Recording> recordings;
  for (int n = 1; n <= 4; ++n) {
    Random random(static_cast<std::uint64_t>(260 + n));
    recordings.push_back(test::commanded("run_" + std::to_string(n), 80000, random, [&](int i, test::CommandedBase& b) {
      if (i % 3000 == 0) {
        const double slow = random.uniform() < 0.4 ? 0.15 : 1.0;
        b.command_mps = slow * random.uniform(-0.4, 0.6), b.command_radps = slow * random.uniform(-0.9, 0.9);
      }
      b.speed_mps = b.command_mps, b.yaw_rate_radps = b.command_radps;
      obeys(b);
    }));
  }
  return recordings;
}

const Response* drawn_over(const Diagnosis& d, const std::string& variable) {
  for (const Response& r : d.responses)
    if (r.variable == variable) return &r;
  return nullptr;
}

TEST(ToldSpeeds, ShowThatABaseIsDeafToCommandsThatAreSmall) {
  const Diagnosis d = diagnose(driven_by_stick([](test::CommandedBase& b) {
                                 if (std::abs(b.speed_mps) < 0.05) b.speed_mps = 0.0;
                               }),
                               {}, Vehicle{})
                          .value();
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  const Response* forward = drawn_over(d, "speed as it is told [m/s]");
  ASSERT_TRUE(forward);
  ASSERT_GT(forward->at.size(), 3U);
  ASSERT_LT(forward->at[1], 0.05);
  // It loses all of its way there; beyond, the hat that stands next hears some of it still.
  EXPECT_NEAR(forward->value[1], -1.0, 0.15);
  EXPECT_NEAR(forward->value[5], 0.0, 0.05);
}

constexpr double kFastest_mps = 0.55, kWheelbase_m = 0.34;

TEST(ToldSpeeds, ShowThatAWheelGoesNoFasterThanItCan) {
  const Diagnosis d = diagnose(driven_by_stick([](test::CommandedBase& b) {
                                 const auto wheel = [&b](double sign) {
                                   return std::clamp(b.speed_mps + sign * 0.5 * kWheelbase_m * b.yaw_rate_radps,
                                                     -kFastest_mps, kFastest_mps);
                                 };
                                 const double left = wheel(-1.0), right = wheel(1.0);
                                 b.speed_mps = 0.5 * (left + right), b.yaw_rate_radps = (right - left) / kWheelbase_m;
                               }),
                               {}, Vehicle{})
                          .value();
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  const Response* wheel = drawn_over(d, "speed of a wheel as it is told [m/s]");
  ASSERT_TRUE(wheel);
  const double fastest_told = wheel->at.back();
  EXPECT_NEAR(wheel->value.back(), kFastest_mps / fastest_told - 1.0, 0.03);
}

// Along the sides of squares, held straight by someone who sees where it heads: what its wheels' noise turned it by is
// taken back at once, and the truth shows neither.
TEST(ToldSpeeds, SayNothingOfWhatADriverSteersAgainst) {
  constexpr double kStep_s = test::CommandedBase::kStep_s, kSpeed_mps = 0.44, kTurn_radps = 0.9, kSide_s = 7.0;
  constexpr double kGain = 1.0, kNoise_rad_per_sqrt_m = 0.011;
  std::vector<Recording> recordings;
  for (int n = 1; n <= 5; ++n) {
    Random random(static_cast<std::uint64_t>(280 + n));
    double along_rad = 0.0, turned_s = 0.0;
    int steps_on_side = 0;
    recordings.push_back(
        test::commanded("run_" + std::to_string(n), 140000, random, [&](int i, test::CommandedBase& b) {
          const bool turns = ++steps_on_side * kStep_s > kSide_s;
          if (turns) turned_s += kStep_s, along_rad += kTurn_radps * kStep_s;
          if (turned_s * kTurn_radps > 0.5 * kPi) turned_s = 0.0, steps_on_side = 0;
          if (i % 40 == 0) {
            b.command_mps = kSpeed_mps;
            b.command_radps = (turns ? kTurn_radps : 0.0) - kGain * (b.heading_rad - along_rad);
          }
          b.speed_mps = b.command_mps;
          b.yaw_rate_radps =
              b.command_radps + kNoise_rad_per_sqrt_m * std::sqrt(kSpeed_mps / kStep_s) * random.normal();
        }));
  }
  EXPECT_EQ(diagnose(recordings, {}, Vehicle{})->verdict, Verdict::nothing_missing);
}

TEST(ToldSpeeds, SayNothingOfABaseThatObeys) {
  EXPECT_EQ(diagnose(driven_by_stick([](test::CommandedBase&) {}), {}, Vehicle{})->verdict, Verdict::nothing_missing);
}

}  // namespace
}  // namespace odolab
