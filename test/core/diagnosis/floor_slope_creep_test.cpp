#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kCreep_mps = 0.0015, kDirection_rad = 0.8;

// Three drives with a rest of a third of their time each, on a floor that slopes.
std::vector<Recording> on_a_slope(Random& random, bool creeps_at_rest) {
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 36.0;
  const auto with_a_rest = [&](int) -> SpeedProfile {
    return [driving = varied_driving(random, g.duration_s)](double t) {
      return t > 12.0 && t < 24.0 ? WheelSpeedsAt{} : driving(t);
    };
  };
  const auto creeping = [=](int) {
    return [=](InjectedStep& s) {
      if (!creeps_at_rest && s.left_radps == 0.0 && s.right_radps == 0.0) return;
      s.room_m = {kCreep_mps * s.dt_s * std::cos(kDirection_rad), kCreep_mps * s.dt_s * std::sin(kDirection_rad)};
    };
  };
  return three_runs(g, random, with_a_rest, creeping);
}

TEST(FloorSlopeCreep, IsMeasuredWhetherItGoesOnAtRestOrNot) {
  for (const bool creeps_at_rest : {true, false}) {
    Random random(91);
    const Diagnosis d = diagnose(on_a_slope(random, creeps_at_rest), {}, Vehicle{}).value();
    ASSERT_EQ(d.findings.size(), 1u);
    EXPECT_EQ(d.findings[0].effect, "floor_slope_creep");
    EXPECT_EQ(d.findings[0].form_in_words, creeps_at_rest ? "moving and at rest" : "while a wheel turns");
    for (const FoundParameter& p : d.findings[0].parameters)
      EXPECT_LT(std::abs(p.value - (p.name == "creep_mps" ? kCreep_mps : kDirection_rad)), 3.0 * p.stderr_value)
          << p.name;
  }
}

}  // namespace
}  // namespace odolab::test
