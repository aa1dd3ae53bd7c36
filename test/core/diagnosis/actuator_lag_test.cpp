#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/commanded_base.h"

namespace odolab {
namespace {

constexpr double kLag_s = 0.065;

// Joystick driving; the base follows with a lag.
Recording driven(int number, double lag_s) {
  Random random(static_cast<std::uint64_t>(70 + number));
  double wanted_mps = 0.0, wanted_radps = 0.0;
  return test::commanded("run_" + std::to_string(number), 80000, random, [&](int i, test::CommandedBase& b) {
    if (i % 3000 == 0) wanted_mps = random.uniform(-0.3, 0.6), wanted_radps = random.uniform(-0.9, 0.9);
    if (i % 40 == 0) {
      b.command_mps += std::clamp(wanted_mps - b.command_mps, -0.02, 0.02);
      b.command_radps += std::clamp(wanted_radps - b.command_radps, -0.06, 0.06);
    }
    const double follows = 1.0 - std::exp(-b.kStep_s / lag_s);
    b.speed_mps += follows * (b.command_mps - b.speed_mps);
    b.yaw_rate_radps += follows * (b.command_radps - b.yaw_rate_radps);
  });
}

// Seen from its commands alone, a base that lags is nearly one that is late.
TEST(ActuatorLag, IsToldFromADelayThatTakesAlmostAllOfIt) {
  std::vector<Recording> recordings;
  for (int n = 1; n <= 4; ++n) recordings.push_back(driven(n, kLag_s));
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.verdict, Verdict::found);
  EXPECT_EQ(d.findings.front().effect, "actuator_lag");
  const FoundParameter& p = d.findings.front().parameters.front();
  EXPECT_LT(std::abs(p.value - kLag_s), 3.0 * p.stderr_value) << p.value << " +- " << p.stderr_value;
  EXPECT_NEAR(p.value, kLag_s, 0.05 * kLag_s);
  for (const Finding& f : d.findings) EXPECT_NE(f.effect, "actuator_delay");
}

}  // namespace
}  // namespace odolab
