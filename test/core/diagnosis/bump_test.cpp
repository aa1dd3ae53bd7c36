#include <gtest/gtest.h>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr Vec2 kPlace{0.45, 0.0};
constexpr double kReach_m = 0.08, kExtra_m = 0.004, kClimbed_m = 0.04;  // across the wheel's way, and along it

// A robot that drives out and home again over something that lies on the floor: by its left wheel on the way out, and,
// turned round, by its right one.
std::vector<Recording> over_and_back(Random& random) {
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 24.0;
  g.start = {0.0, -0.17, 0.0};  // the left wheel's line goes through the place
  const double turn_s = kPi * 0.17 / (4.0 * 0.075);
  const auto profile = [=](double t) {
    const double in_leg = std::fmod(t, 4.0 + turn_s + 0.5);
    if (in_leg < 4.0) return WheelSpeedsAt{4.0, 4.0};
    if (in_leg < 4.0 + turn_s) return WheelSpeedsAt{-4.0, 4.0};
    return WheelSpeedsAt{};
  };
  std::vector<Recording> recordings;
  for (int run = 0; run < 2; ++run) {
    g.inject = [=, b = g.drive.wheelbase_m](InjectedStep& s) {
      for (int wheel = 0; wheel < 2; ++wheel) {
        const Vec2 from_wheel = inverse(s.pose) * kPlace - Vec2{0.0, wheel == 0 ? 0.5 * b : -0.5 * b};
        if (std::abs(from_wheel.x_m) > 0.5 * kClimbed_m || std::abs(from_wheel.y_m) > kReach_m) continue;
        double& way_m = wheel == 0 ? s.left_m : s.right_m;
        way_m *= 1.0 - kExtra_m / kClimbed_m;
      }
    };
    recordings.push_back(generated(g, profile, random));
    recordings.back().name = "run_" + std::to_string(run + 1);
  }
  return recordings;
}

TEST(Bump, IsOneThingOnTheFloorThoughEitherWheelMeetsIt) {
  Random random(44);
  const Diagnosis d = diagnose(over_and_back(random), {}, Vehicle{}).value();
  ASSERT_FALSE(d.findings.empty());
  const Finding& f = d.findings.front();
  ASSERT_EQ(f.effect, "bump");
  EXPECT_EQ(f.component, "both_wheels");
  for (const FoundParameter& p : f.parameters) {
    // Four standard errors: a right tool is outside one time in sixteen thousand, and the seed is fixed.
    if (p.name == "extra_distance_m") {
      EXPECT_LT(std::abs(p.value - kExtra_m), 4.0 * p.stderr_value);
    } else {  // it is met anywhere within reach
      const bool is_x = p.name == "x_m";
      EXPECT_NEAR(p.value, is_x ? kPlace.x_m : kPlace.y_m, is_x ? kReach_m : 2.0 * kReach_m) << p.name;
    }
  }
  int physics = 0;
  for (const Finding& other : d.findings)
    physics += other.effect == "bump" || other.effect == "slip_zone" || other.effect == "collision";
  EXPECT_EQ(physics, 1);
}

}  // namespace
}  // namespace odolab::test
