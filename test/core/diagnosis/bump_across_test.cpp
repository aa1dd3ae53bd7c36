#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/geometry/angles.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kRolling_m = 0.075, kApart_m = 0.34, kCircle_m = 0.6;
constexpr Vec2 kMiddle{0.3, 0.0};
constexpr double kAlongCable_rad = 1.9, kLength_m = 1.0, kHeight_m = 0.011;

// How far a wheel travels of what it rolls while it stands on a cable: by the angle at which it climbs.
double horizontal_share(const Pose& axle, double beside_m) {
  const Vec2 along{std::cos(kAlongCable_rad), std::sin(kAlongCable_rad)},
      ahead{std::cos(axle.heading_rad), std::sin(axle.heading_rad)};
  const Vec2 to = kMiddle - axle * Vec2{0.0, beside_m};
  const double across = cross(ahead, along);
  if (std::abs(across) < 0.05) return 1.0;
  const double u = cross(to, along) / across;
  const double reach_m = std::sqrt(2.0 * kRolling_m * kHeight_m - kHeight_m * kHeight_m);
  if (std::abs(u) > reach_m || std::abs(dot(u * ahead - to, along)) > 0.5 * kLength_m) return 1.0;
  return std::sqrt(1.0 - u * u / (kRolling_m * kRolling_m));
}

// Eights, whose inner and outer wheels cross the cable at four places, and pass beyond its ends at four others.
std::vector<Recording> eights_over_a_cable(Random& random) {
  GeneratorSettings g = under_motion_capture({kRolling_m, kRolling_m, kApart_m}, 0.0005, 0.01);
  constexpr double kSpeed_mps = 0.3, kRound_s = 2.0 * kPi * kCircle_m / kSpeed_mps;
  g.duration_s = 4.0 * kRound_s;
  const auto eights = [=](double t) {
    const double side = std::fmod(t, 2.0 * kRound_s) < kRound_s ? 1.0 : -1.0;
    const double by = side * 0.5 * kApart_m / kCircle_m, wheel_radps = kSpeed_mps / kRolling_m;
    return WheelSpeedsAt{wheel_radps * (1.0 - by), wheel_radps * (1.0 + by)};
  };
  const auto climbing = [](int) {
    return [](InjectedStep& s) {
      s.left_m *= horizontal_share(s.pose, 0.5 * kApart_m);
      s.right_m *= horizontal_share(s.pose, -0.5 * kApart_m);
    };
  };
  return three_runs(
      g, random, [&](int) { return SpeedProfile(eights); }, climbing);
}

TEST(BumpAcross, IsOneCableThoughEveryWayCrossesItElsewhere) {
  const double reach_m = std::sqrt(2.0 * kRolling_m * kHeight_m - kHeight_m * kHeight_m),
               extra_m = 2.0 * (kRolling_m * std::asin(reach_m / kRolling_m) - reach_m);
  Random random(461);
  const Diagnosis d = diagnose(eights_over_a_cable(random), {}, Vehicle{}).value();
  EXPECT_EQ(d.verdict, Verdict::found);
  int physics = 0;
  for (const Finding& f : d.findings) {
    if (f.effect.rfind("truth_", 0) == 0) continue;
    ++physics;
    ASSERT_EQ(f.effect, "bump");
    EXPECT_EQ(f.component, "both_wheels");
    double direction_rad = 0.0, length_m = 0.0;
    for (const FoundParameter& p : f.parameters) {
      // Four standard errors: a right tool is outside one time in sixteen thousand, and the seed is fixed.
      if (p.name == "extra_distance_m") {
        EXPECT_LT(std::abs(p.value - extra_m), 4.0 * p.stderr_value);
      }
      if (p.name == "direction_rad") direction_rad = p.value;
      if (p.name == "length_m") length_m = p.value;
    }
    // Along its own length it may lie anywhere between what was crossed and what was passed, so the place tells less.
    EXPECT_NEAR(std::remainder(direction_rad - kAlongCable_rad, kPi), 0.0, 0.05);
    EXPECT_GT(length_m, 0.5);
    EXPECT_LT(length_m, 2.0);
  }
  EXPECT_EQ(physics, 1);
}

}  // namespace
}  // namespace odolab::test
