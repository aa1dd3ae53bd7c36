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

}  // namespace
}  // namespace odolab
