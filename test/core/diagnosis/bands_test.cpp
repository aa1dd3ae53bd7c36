#include "core/diagnosis/generic/bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/generic/groups.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// A robot whose left wheel goes so much less far than it turns while it turns between 3.0 and 3.12 rad/s, as where it
// shakes; seen by cameras that err by a centimetre.
Diagnosis shaking(double lost) {
  Random random(68);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0004, 0.1);
  g.truth_position_noise_m = 0.01;
  g.truth_heading_noise_rad = 0.02;
  g.duration_s = 90.0;
  const auto shakes = [&](int) {
    return [lost](InjectedStep& s) {
      if (s.left_radps > 3.0 && s.left_radps < 3.12) s.left_m *= 1.0 - lost;
    };
  };
  // Up and down, over and over, so that a wheel is never long at one speed.
  const auto driving = [](int run) {
    return [run](double t) {
      const double pace = 3.5 + 2.0 * std::sin(0.5 * t + run), turn = 1.2 * std::sin(0.37 * t + 2.0 * run);
      return WheelSpeedsAt{pace - turn, pace + turn};
    };
  };
  return diagnose(three_runs(g, random, driving, shakes), {}, Vehicle{}).value();
}

// Hats over all speeds are too wide for it: without bands it is another name.
TEST(Bands, ShowAWheelThatShakesAtOneSpeed) {
  const Diagnosis d = shaking(0.12);
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  const std::string& regime = d.findings.front().where.regime;
  EXPECT_NE(regime.find(" between "), std::string::npos) << regime;
}

TEST(Bands, ShowNothingOfAWheelThatRolls) { EXPECT_EQ(shaking(0.0).verdict, Verdict::nothing_missing); }

// What is to the left of a drive is to the right of its mirror image: hats over yaw rates stand as far to the one side
// of it as to the other of this.
TEST(Hats, StandInAMirroredDriveWhereTheyStandInTheDrive) {
  const auto hats_over_yaw_rates = [](double straight_radps, double sense) {
    DriveView view;
    Random random(3);
    for (int i = 0; i < 7000; ++i) {
      EffectStep s;
      s.speed_mps = 0.3;
      s.yaw_rate_radps = sense * (i % 3 == 0 ? random.uniform(-0.5, 1.0) : random.uniform(0.0, 0.25));
      view.steps.push_back(s);
    }
    for (const Group& g : groups_of({view}, {0.03, straight_radps, 0.34}))
      if (g.variable == "yaw rate [rad/s]") return g.at;
    return std::vector<double>{};
  };
  for (const double straight_radps : {0.1, 0.18, 0.26}) {
    const std::vector<double> at = hats_over_yaw_rates(straight_radps, 1.0);
    std::vector<double> mirrored = hats_over_yaw_rates(straight_radps, -1.0);
    std::reverse(mirrored.begin(), mirrored.end());
    ASSERT_GE(at.size(), 2u);
    ASSERT_EQ(mirrored.size(), at.size());
    for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(-mirrored[k], at[k], 1e-9) << straight_radps << ", " << k;
  }
}

}  // namespace
}  // namespace odolab::test
