#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kScrub_per_radps = 0.03;

// Straights, and turns at so many rates, one after the other.
SpeedProfile turning_at_rates(std::vector<double> rates_radps) {
  const DifferentialDrive drive;
  return [=](double t) {
    constexpr double kStraight_s = 3.0, kTurn_s = 2.0;
    const auto leg = static_cast<std::size_t>(t / (kStraight_s + kTurn_s));
    if (std::fmod(t, kStraight_s + kTurn_s) < kStraight_s) return WheelSpeedsAt{4.0, 4.0};
    const double turning = 0.5 * rates_radps[leg % rates_radps.size()] * drive.wheelbase_m / drive.wheel_radius_left_m;
    return WheelSpeedsAt{-turning, turning};
  };
}

Recording driven_at_rates(const std::vector<double>& rates_radps, Random& random, const std::string& name) {
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.01);
  g.duration_s = 60.0;
  g.inject = [](InjectedStep& s) {  // omega (1 + k |omega|) is what the wheels roll
    const DifferentialDrive drive;
    const double rolled_radps = (s.right_m - s.left_m) / drive.wheelbase_m / s.dt_s,
                 turns_radps = (std::sqrt(1.0 + 4.0 * kScrub_per_radps * std::abs(rolled_radps)) - 1.0) /
                               (2.0 * kScrub_per_radps);
    s.turn_rad += (std::copysign(turns_radps, rolled_radps) - rolled_radps) * s.dt_s;
  };
  Recording r = generated(g, turning_at_rates(rates_radps), random);
  r.name = name;
  return r;
}

// At one turn rate a scrub is another wheelbase; at two others it is not.
TEST(NamedBesideHeldOut, IsAScrubThatTheWheelbaseTakesUpInTheRunsThatWereGiven) {
  Random random(91);
  const std::vector<Recording> given{driven_at_rates({1.5, -1.5}, random, "run_1"),
                                     driven_at_rates({-1.5, 1.5}, random, "run_2"),
                                     driven_at_rates({1.5, 1.5}, random, "run_3")};
  const std::vector<Recording> held_out{driven_at_rates({0.5, -2.5, 2.5, -0.5}, random, "run_4")};
  const Diagnosis alone = diagnose(given, {}, Vehicle{}).value();
  EXPECT_EQ(alone.verdict, Verdict::nothing_missing) << "nothing shows in these";
  const Diagnosis d = diagnose(given, held_out, Vehicle{}).value();
  ASSERT_EQ(d.verdict, Verdict::found);
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "turn_scrub");
  const FoundParameter& p = d.findings[0].parameters[0];
  EXPECT_NEAR(p.value, kScrub_per_radps, 3.0 * p.stderr_value);
  EXPECT_TRUE(d.left_out_in_turn) << "what it is proved on";
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("those held out were fitted too") != std::string::npos;
  }));
}

}  // namespace
}  // namespace odolab::test
