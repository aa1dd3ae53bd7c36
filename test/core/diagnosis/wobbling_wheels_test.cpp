#include "core/diagnosis/generic/wobbling_wheels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// A right wheel on a bent axle: its contact goes in and out by 3 mm of a wheelbase of 0.34 m once a turn.
TEST(WobblingWheels, AreUnknownByABentAxle) {
  constexpr double kInAndOut = 0.003 / 0.34;
  Random random(166);
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01);
  g.duration_s = 60.0;
  const auto bent = [&](int run) {
    return [&, run](test::InjectedStep& s) {
      const double turn_rad = (s.right_m - s.left_m) / g.drive.wheelbase_m;
      s.turn_rad -= kInAndOut * std::cos(s.right_rad + run) * turn_rad;
    };
  };
  const Result<Diagnosis> d =
      diagnose(test::three_runs(
                   g, random, [&](int) { return test::varied_driving(random, g.duration_s); }, bent),
               {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_EQ(d->findings.front().component, "right_wheel");
  EXPECT_EQ(d->findings.front().where.regime, "turn per turn [1] that depends on the right wheel's angle, once a turn");
}

}  // namespace
}  // namespace odolab
