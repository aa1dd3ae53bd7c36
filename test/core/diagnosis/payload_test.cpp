#include <gtest/gtest.h>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

TEST(PayloadRadiusChange, IsKnownToTheRestThatItCameIn) {
  constexpr double kFrom_s = 18.0, kTo_s = 24.0, kLoaded_s = 19.0;
  Random random(51);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 45.0;
  const auto with_a_rest = [&](int) -> SpeedProfile {
    return [driving = varied_driving(random, g.duration_s)](double t) {
      return t > kFrom_s && t < kTo_s ? WheelSpeedsAt{} : driving(t);
    };
  };
  const auto loaded = [](int run) {
    return [run](InjectedStep& s) {
      if (run == 1 && s.time_s > kLoaded_s) s.left_m *= 0.994, s.right_m *= 0.997;
    };
  };
  const std::vector<Recording> recordings = three_runs(g, random, with_a_rest, loaded);
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "payload_radius_change");
  for (const FoundParameter& p : d.findings[0].parameters) {
    if (p.name != "at_s") continue;
    EXPECT_NEAR(p.value, 0.5 * (kFrom_s + kTo_s), 0.3);                     // any time of it is as likely
    EXPECT_NEAR(p.stderr_value, (kTo_s - kFrom_s) / std::sqrt(12.0), 0.3);  // that of an even distribution
  }
}

}  // namespace
}  // namespace odolab::test
