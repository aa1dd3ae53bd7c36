#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/commanded_base.h"

namespace odolab {
namespace {

// Commands that change at once. The base asks for one now and then, 0.05 to 0.25 s after the last time, and keeps it
// until it asks again; of its forward speed it loses `loss` for each radian a second.
Recording asked_now_and_then(int number, double loss) {
  Random random(static_cast<std::uint64_t>(400 + number));
  double asks_at_s = 0.0, changes_at_s = 1.0;
  return test::commanded("run_" + std::to_string(number), 120000, random, [&](int i, test::CommandedBase& b) {
    const double t = b.kStep_s * i;
    if (t >= changes_at_s) {
      changes_at_s = t + random.uniform(0.4, 2.0);
      const double kind = random.uniform();
      b.command_mps = kind < 0.15 ? 0.0 : random.uniform(0.1, 0.4);
      b.command_radps = kind < 0.5 ? 0.0 : random.uniform(-0.8, 0.8);
    }
    if (t >= asks_at_s) {
      asks_at_s = t + random.uniform(0.05, 0.25);
      b.speed_mps = b.command_mps * (1.0 - loss * std::abs(b.command_radps));
      b.yaw_rate_radps = b.command_radps;
    }
  });
}

Diagnosis diagnosed_with_loss(double loss) {
  std::vector<Recording> recordings;
  for (int n = 1; n <= 3; ++n) recordings.push_back(asked_now_and_then(n, loss));
  return diagnose(recordings, {}, Vehicle{}).value();
}

// That the base is late, and on average takes up a change bit by bit, is no more than it does.
bool is_late(const Finding& f) {
  return f.effect == "actuator_delay" || f.effect == "actuator_lag" || f.effect == "truth_time_offset";
}

// Commands that are acted on sooner one time and later the next leave what looks like pushes, and hid what is missing:
// of a real robot a loss in turns had been *unknown*.
TEST(CommandTiming, IsNoiseWhereABaseAsksForCommandsNowAndThen) {
  const Diagnosis d = diagnosed_with_loss(0.0);
  EXPECT_NE(d.verdict, Verdict::unknown_effect);
  for (const Finding& f : d.findings) EXPECT_TRUE(is_late(f)) << f.effect;
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("acts on each change of its command") != std::string::npos;
  }));
}

TEST(CommandTiming, HidesNoLossInTurns) {
  constexpr double kLoss = 0.3;
  const Diagnosis d = diagnosed_with_loss(kLoss);
  EXPECT_NE(d.verdict, Verdict::unknown_effect);
  ASSERT_FALSE(d.findings.empty());
  const Finding& f = d.findings.front();
  ASSERT_EQ(f.effect, "turn_speed_loss");
  EXPECT_NEAR(f.parameters[0].value, kLoss, 3.0 * f.parameters[0].stderr_value);
  for (std::size_t k = 1; k < d.findings.size(); ++k) EXPECT_TRUE(is_late(d.findings[k])) << d.findings[k].effect;
}

// A base that overshoots is late by as much in a run that was held out as in those that were fitted. What the timing of
// its changes excuses had put that clock tens of milliseconds off, and the run's error to three times theirs.
TEST(CommandTiming, LeavesAHeldOutRunItsClock) {
  std::vector<Recording> recordings;
  for (int n = 1; n <= 4; ++n) {
    Random random(static_cast<std::uint64_t>(440 + n));
    double changes_at_s = 1.0, target_mps = 0.0, target_radps = 0.0, gains_mps2 = 0.0, gains_radps2 = 0.0;
    recordings.push_back(
        test::commanded("run_" + std::to_string(n), 60000, random, [&](int i, test::CommandedBase& b) {
          constexpr double kSpeedsUp_mps2 = 0.4, kTurnsUp_radps2 = 1.6;
          constexpr double kSwings_radps = 12.0, kDamped = 0.4;
          if (b.kStep_s * i >= changes_at_s) {
            changes_at_s = b.kStep_s * i + random.uniform(0.8, 3.0);
            target_mps = random.uniform() < 0.2 ? 0.0 : random.uniform(0.1, 0.4);
            target_radps = random.uniform() < 0.5 ? 0.0 : random.uniform(-0.8, 0.8);
          }
          const auto towards = [&](double now, double to, double at_most) {
            return now + std::clamp(to - now, -at_most * b.kStep_s, at_most * b.kStep_s);
          };
          b.command_mps = towards(b.command_mps, target_mps, kSpeedsUp_mps2);
          b.command_radps = towards(b.command_radps, target_radps, kTurnsUp_radps2);
          const auto follow = [&](double& speed, double& gains, double command) {
            gains += b.kStep_s * kSwings_radps * (kSwings_radps * (command - speed) - 2.0 * kDamped * gains);
            speed += b.kStep_s * gains;
          };
          follow(b.speed_mps, gains_mps2, b.command_mps);
          follow(b.yaw_rate_radps, gains_radps2, b.command_radps);
        }));
  }
  const std::vector<Recording> train(recordings.begin(), recordings.end() - 1);
  const Diagnosis d = diagnose(train, {recordings.back()}, Vehicle{}).value();
  ASSERT_TRUE(d.train.with_findings && d.held_out.with_findings);
  // One drive of a minute is no other's, by a third.
  EXPECT_LT(d.held_out.with_findings->position_rms_m, 1.33 * d.train.with_findings->position_rms_m);
}

}  // namespace
}  // namespace odolab
