// Radii that change otherwise than in proportion to the time or the speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kRollingRadius_m = 0.075;

// Each recording at a pace of its own: what goes by the way goes by no time.
std::vector<Recording> at_three_paces(std::uint64_t seed,
                                      const std::function<std::function<void(InjectedStep&)>(int run)>& inject) {
  Random random(seed);
  GeneratorSettings g = under_motion_capture({kRollingRadius_m, kRollingRadius_m, 0.34}, 0.0008, 0.02);
  g.duration_s = 50.0;
  const auto driving = [&](int run) -> SpeedProfile {
    return [pace = 0.4 + 0.6 * run, driving = varied_driving(random, g.duration_s)](double t) {
      const WheelSpeedsAt w = driving(t);
      return WheelSpeedsAt{pace * w.left_radps, pace * w.right_radps};
    };
  };
  return three_runs(g, random, driving, inject);
}

double parameter_of(const Finding& f, const std::string& name) { return f.as_active().parameter(name); }

double stderr_of(const Finding& f, const std::string& name) {
  for (const FoundParameter& p : f.parameters)
    if (p.name == name) return p.stderr_value;
  return 0.0;
}

// Tyres that were left in the wet: they slip by 5 % and dry off within six metres, in each recording anew.
TEST(GrowingRadii, AreADriftByTheWayWhereTyresDryAsTheyRoll) {
  constexpr double kSlips = 0.05, kDries_m = 6.0;
  const auto drying = [](int) {
    return [left_m = 0.0, right_m = 0.0](InjectedStep& s) mutable {
      left_m += kRollingRadius_m * std::abs(s.left_radps) * s.dt_s,
          right_m += kRollingRadius_m * std::abs(s.right_radps) * s.dt_s;
      s.left_m *= 1.0 - kSlips * std::exp(-left_m / kDries_m);
      s.right_m *= 1.0 - kSlips * std::exp(-right_m / kDries_m);
    };
  };
  const Diagnosis d = diagnose(at_three_paces(74, drying), {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  const Finding& f = d.findings[0];
  ASSERT_EQ(f.effect, "radius_drift");
  EXPECT_EQ(f.component, "both_wheels");
  // At first they grow by so much a metre, of what they are then; by the form whose end is nearest, of 5.8 m, by a
  // thirtieth more.
  const double at_first_per_m = kSlips / (1.0 - kSlips) / kDries_m;
  EXPECT_NEAR(parameter_of(f, "per_s") / parameter_of(f, "at_mps"), at_first_per_m, 0.05 * at_first_per_m);
}

TEST(GrowingRadii, WearByTheWayThatWheelsRoll) {
  constexpr double kPerMetre = 5e-4;
  const auto wearing = [](int) {
    return [left_m = 0.0, right_m = 0.0](InjectedStep& s) mutable {
      left_m += kRollingRadius_m * std::abs(s.left_radps) * s.dt_s,
          right_m += kRollingRadius_m * std::abs(s.right_radps) * s.dt_s;
      s.left_m *= 1.0 - kPerMetre * left_m, s.right_m *= 1.0 - kPerMetre * right_m;
    };
  };
  const Diagnosis d = diagnose(at_three_paces(76, wearing), {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  const Finding& f = d.findings[0];
  ASSERT_EQ(f.effect, "radius_drift");
  const double at_mps = parameter_of(f, "at_mps");
  // Four standard errors: a right tool is outside one time in sixteen thousand, and the seed is fixed.
  EXPECT_NEAR(parameter_of(f, "per_s"), -kPerMetre * at_mps, 4.0 * stderr_of(f, "per_s"));
}

TEST(GrowingRadii, GoByTheSquareOfASpeedWhereTheyAreFlungOut) {
  constexpr double kPerSquare = 0.03;
  const auto flung = [](int) {
    return [](InjectedStep& s) {
      s.left_m *= 1.0 + kPerSquare * std::pow(kRollingRadius_m * s.left_radps, 2);
      s.right_m *= 1.0 + kPerSquare * std::pow(kRollingRadius_m * s.right_radps, 2);
    };
  };
  const Diagnosis d = diagnose(at_three_paces(77, flung), {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  const Finding& f = d.findings[0];
  ASSERT_EQ(f.effect, "speed_dependent_radius");
  EXPECT_NEAR(parameter_of(f, "per_mps"), kPerSquare * parameter_of(f, "at_mps"), 4.0 * stderr_of(f, "per_mps"));
}

// Tyres that lose their grip as they get dusty and have it back where they are wiped, some metres on.
TEST(RadiiByWay, AreUnknownWhereTheyComeAndGoWithIt) {
  constexpr double kMost = 0.03, kBetween_m = 14.0;
  const auto dusty = [](int) {
    return [rolled_m = 0.0](InjectedStep& s) mutable {
      rolled_m += 0.5 * kRollingRadius_m * (std::abs(s.left_radps) + std::abs(s.right_radps)) * s.dt_s;
      const double slips = kMost * std::pow(std::sin(kPi * rolled_m / kBetween_m), 2);
      s.left_m *= 1.0 - slips, s.right_m *= 1.0 - slips;
    };
  };
  const Diagnosis d = diagnose(at_three_paces(74, dusty), {}, Vehicle{}).value();
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_EQ(d.findings.front().where.regime, "size of the wheels that depends on way since the start [m]");
}

// What steps at one moment is no law of the way: the load is said, and so is a drift beside it.
TEST(RadiiByWay, LeaveALoadAndADriftWhatTheyAre) {
  constexpr double kLoaded_s = 24.0, kPerSecond = 3e-4;
  const auto loaded = [](int run) {
    return [=](InjectedStep& s) {
      const double by = (run == 1 && s.time_s > kLoaded_s ? 0.975 : 1.0) * (1.0 + kPerSecond * s.time_s);
      s.left_m *= by, s.right_m *= by;
    };
  };
  const std::vector<Recording> recordings = at_three_paces(75, loaded);
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  EXPECT_NE(d.verdict, Verdict::unknown_effect);
  const auto is_said = [&](const char* effect) {
    return std::any_of(d.findings.begin(), d.findings.end(), [&](const Finding& f) { return f.effect == effect; });
  };
  EXPECT_TRUE(is_said("payload_radius_change"));
  EXPECT_TRUE(is_said("radius_drift"));
}

}  // namespace
}  // namespace odolab::test
