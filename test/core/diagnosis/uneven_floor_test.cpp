#include <gtest/gtest.h>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Runs on a floor on which whatever turns its wheels creeps by so much.
Diagnosis on_a_floor(const std::function<Vec2(const Vec2& place)>& creep_mps) {
  Random random(61);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.05);
  g.duration_s = 60.0;
  const auto creeps = [&](int) {
    return [creep_mps](InjectedStep& s) {
      if (s.left_radps != 0.0 || s.right_radps != 0.0) s.room_m = s.room_m + s.dt_s * creep_mps(s.pose.position());
    };
  };
  const auto driving = [&](int) { return varied_driving(random, g.duration_s); };
  return diagnose(three_runs(g, random, driving, creeps), {}, Vehicle{}).value();
}

TEST(UnevenFloor, IsNoSlopeWhereAllCreepsTowardsADrain) {
  const Vec2 drain{0.3, -0.4};
  const Diagnosis d = on_a_floor([&](const Vec2& place) { return 0.004 * (drain - place); });
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_EQ(d.findings.front().component, "floor");
  EXPECT_NE(d.findings.front().where.regime.find("creep across the floor"), std::string::npos)
      << d.findings.front().where.regime;
}

TEST(UnevenFloor, IsASlopeWhereAllCreepsOneWay) {
  const Diagnosis d = on_a_floor([](const Vec2&) { return Vec2{0.003, -0.002}; });
  ASSERT_EQ(d.verdict, Verdict::found);
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings.front().effect, "floor_slope_creep");
}

}  // namespace
}  // namespace odolab::test
