#include "core/diagnosis/generic/swinging.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// A tank, half full: what is in it runs to the outside of a bend and to and fro for a while, and turns the vehicle by
// so much for each metre that it is off its middle.
std::vector<Recording> with_a_tank(double rad_per_m) {
  constexpr double kPeriod_s = 1.6, kDampingRatio = 0.07;
  Random random(71);
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0006, 0.02);
  g.duration_s = 60.0;
  const auto sloshes = [rad_per_m](int) {
    return [rad_per_m, off_m = 0.0, pace_mps = 0.0](test::InjectedStep& s) mutable {
      const double own_radps = 2.0 * kPi / kPeriod_s;
      const double speed_mps = 0.0375 * (s.left_radps + s.right_radps),
                   yaw_rate_radps = 0.075 * (s.right_radps - s.left_radps) / 0.34;
      pace_mps -= s.dt_s * (own_radps * own_radps * off_m + 2.0 * kDampingRatio * own_radps * pace_mps +
                            speed_mps * yaw_rate_radps);
      off_m += s.dt_s * pace_mps;
      s.turn_rad += rad_per_m * s.dt_s * pace_mps;
    };
  };
  return test::three_runs(
      g, random, [&](int) { return test::varied_driving(random, g.duration_s); }, sloshes);
}

TEST(Swinging, IsHeardThoughItGoesOnForLong) {
  const Diagnosis d = diagnose(with_a_tank(2.5), {}, Vehicle{}).value();
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_NE(d.findings.front().where.regime.find("swung on in 1.6 s"), std::string::npos)
      << d.findings.front().where.regime;
}

TEST(Swinging, IsNotHeardOfAnEmptyTank) {
  EXPECT_EQ(diagnose(with_a_tank(0.0), {}, Vehicle{})->verdict, Verdict::nothing_missing);
}

}  // namespace
}  // namespace odolab
