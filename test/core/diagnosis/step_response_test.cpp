#include "core/diagnosis/generic/step_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/commanded_base.h"

namespace odolab {
namespace {

// A stick that is pushed to somewhere else every second and a half; the base follows as an oscillator of second order,
// of 20 rad/s and that damping.
Recording driven_with_damping(int number, double damping) {
  constexpr double kOwn_radps = 20.0;
  Random random(static_cast<std::uint64_t>(170 + number));
  double speed_up_mps2 = 0.0, turn_up_radps2 = 0.0;
  return test::commanded("run_" + std::to_string(number), 80000, random, [&](int i, test::CommandedBase& b) {
    if (i > 0 && i % 3000 == 0) b.command_mps = random.uniform(-0.3, 0.6), b.command_radps = random.uniform(-0.9, 0.9);
    const auto follow = [&](double& pace, double& change, double command) {
      change += b.kStep_s * (kOwn_radps * kOwn_radps * (command - pace) - 2.0 * damping * kOwn_radps * change);
      pace += b.kStep_s * change;
    };
    follow(b.speed_mps, speed_up_mps2, b.command_mps);
    follow(b.yaw_rate_radps, turn_up_radps2, b.command_radps);
  });
}

std::vector<Recording> runs_with_damping(double damping) {
  std::vector<Recording> recordings;
  for (int n = 1; n <= 4; ++n) recordings.push_back(driven_with_damping(n, damping));
  return recordings;
}

// It overshoots by exp(-pi damping / sqrt(1 - damping^2)) = 44 % of each change, half a period after it, 0.16 s.
TEST(StepResponse, ShowsABaseThatOvershootsWhichIsNoLag) {
  const Diagnosis d = diagnose(runs_with_damping(0.25), {}, Vehicle{}).value();
  EXPECT_EQ(d.verdict, Verdict::unknown_effect);
  const auto response = std::find_if(d.responses.begin(), d.responses.end(), [](const Response& r) {
    return r.variable == "time since its command changed [s]";
  });
  ASSERT_NE(response, d.responses.end());
  const auto most = std::max_element(response->value.begin(), response->value.end());
  EXPECT_GT(*most, 0.1);
  EXPECT_NEAR(response->at[static_cast<std::size_t>(most - response->value.begin())], 0.16, 0.06);
}

// Damped by half as much again as is critical it is two lags in a row, of 0.13 and 0.019 s: a lag that is a little
// late.
TEST(StepResponse, LeavesABaseThatCreepsUpToItsCommandsToItsLag) {
  const Diagnosis d = diagnose(runs_with_damping(1.5), {}, Vehicle{}).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().effect, "actuator_lag");
  EXPECT_NE(d.verdict, Verdict::unknown_effect);
}

// A stick that is pushed to somewhere else now and then; each wheel by itself makes of its command what `follow` says,
// in a step of that time.
std::vector<Recording> driven_by_wheels(double (*follow)(double wheel_mps, double command_mps, double step_s)) {
  std::vector<Recording> recordings;
  for (int number = 1; number <= 4; ++number) {
    Random random(static_cast<std::uint64_t>(270 + number));
    const double half_base_m = 0.5 * DifferentialDrive{}.wheelbase_m;
    double left_mps = 0.0, right_mps = 0.0, next = 2000.0;
    recordings.push_back(
        test::commanded("run_" + std::to_string(number), 80000, random, [&](int i, test::CommandedBase& b) {
          if (i > next) {
            b.command_mps = random.uniform(-0.3, 0.6), b.command_radps = random.uniform(-0.9, 0.9);
            next += random.uniform(1500.0, 4500.0);
          }
          left_mps = follow(left_mps, b.command_mps - half_base_m * b.command_radps, b.kStep_s);
          right_mps = follow(right_mps, b.command_mps + half_base_m * b.command_radps, b.kStep_s);
          b.speed_mps = 0.5 * (left_mps + right_mps);
          b.yaw_rate_radps = 0.5 * (right_mps - left_mps) / half_base_m;
        }));
  }
  return recordings;
}

// A motor drives its wheel within 40 ms; where it is told to go more slowly it lets the wheel run out.
TEST(StepResponse, ShowsWheelsThatCoastWhereTheyAreToldToGoMoreSlowly) {
  const Diagnosis d = diagnose(driven_by_wheels([](double wheel_mps, double command_mps, double step_s) {
                                 const double within_s = std::abs(command_mps) < std::abs(wheel_mps) ? 0.25 : 0.04;
                                 return wheel_mps + (command_mps - wheel_mps) * step_s / within_s;
                               }),
                               {}, Vehicle{})
                          .value();
  EXPECT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_NE(d.findings.front().where.regime.find("told to go more slowly"), std::string::npos)
      << d.findings.front().where.regime;
}

// A drive that limits accelerations takes longer over larger changes, which no lag does.
TEST(StepResponse, ShowsADriveThatLimitsItsAccelerations) {
  const Diagnosis d =
      diagnose(driven_by_wheels([](double wheel_mps, double command_mps, double step_s) {
                 constexpr double kMost_mps2 = 1.2;
                 return wheel_mps + std::clamp(command_mps - wheel_mps, -kMost_mps2 * step_s, kMost_mps2 * step_s);
               }),
               {}, Vehicle{})
          .value();
  EXPECT_EQ(d.verdict, Verdict::unknown_effect);
}

}  // namespace
}  // namespace odolab
