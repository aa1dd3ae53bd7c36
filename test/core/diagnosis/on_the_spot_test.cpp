#include "core/diagnosis/generic/on_the_spot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Robots that go straight, turn on the spot to either side and drive curves; where their wheels go against each other,
// they go ahead by so much for each radian.
Diagnosis walking(double ahead_m_per_rad) {
  Random random(66);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0008, 0.02);
  g.duration_s = 60.0;
  const auto walks = [&](int) {
    return [ahead_m_per_rad](InjectedStep& s) {
      if (s.left_radps * s.right_radps >= 0.0) return;
      const double ahead_m = ahead_m_per_rad * std::abs(s.right_m - s.left_m) / DifferentialDrive{}.wheelbase_m;
      s.left_m += ahead_m, s.right_m += ahead_m;
    };
  };
  const auto driving = [&](int) { return varied_driving(random, g.duration_s); };
  return diagnose(three_runs(g, random, driving, walks), {}, Vehicle{}).value();
}

TEST(OnTheSpot, IsUnknownWhereAVehicleWalksAsItTurns) {
  const Diagnosis d = walking(0.004);
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_NE(d.findings.front().where.regime.find("turning on the spot"), std::string::npos)
      << d.findings.front().where.regime;
}

TEST(OnTheSpot, IsNothingWhereItDoesNot) { EXPECT_EQ(walking(0.0).verdict, Verdict::nothing_missing); }

}  // namespace
}  // namespace odolab::test
