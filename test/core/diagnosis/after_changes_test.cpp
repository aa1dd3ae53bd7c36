#include "core/diagnosis/generic/after_changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// A load that swings within the base, and pushes it back and forth after each change of speed while the wheels are
// held: by so large a share of the change, at that frequency, halved within that time.
constexpr double kShare = 0.03, kFrequency_hz = 1.0, kHalved_s = 0.6;

TEST(AfterChanges, ShowALoadThatSwingsWhenTheSpeedHasChanged) {
  Random random(51);
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01);
  g.duration_s = 60.0;
  const auto swinging = [](int) {
    return [at_m = 0.0, pace_mps = 0.0, before_mps = 0.0](test::InjectedStep& s) mutable {
      const double now_mps = 0.0375 * (s.left_radps + s.right_radps);
      const double own_radps = 2.0 * kPi * kFrequency_hz, damping = std::log(2.0) / kHalved_s;
      pace_mps += kShare * (now_mps - before_mps);
      pace_mps -= s.dt_s * (own_radps * own_radps * at_m + 2.0 * damping * pace_mps);
      before_mps = now_mps;
      const double by_m = s.dt_s * pace_mps;
      at_m += by_m;
      s.left_m += by_m, s.right_m += by_m;
    };
  };
  const Result<Diagnosis> d =
      diagnose(test::three_runs(
                   g, random, [&](int) { return test::varied_driving(random, g.duration_s); }, swinging),
               {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_NE(d->findings.front().where.regime.find("time since its speed changed"), std::string::npos)
      << d->findings.front().where.regime;
  const auto drawn = std::find_if(d->responses.begin(), d->responses.end(),
                                  [](const Response& r) { return r.variable == "time since its speed changed [s]"; });
  ASSERT_NE(drawn, d->responses.end());
  // Back at half a period, by what damping leaves of the share; hats are a quarter of a period wide.
  const auto least = std::min_element(drawn->value.begin(), drawn->value.end());
  EXPECT_NEAR(drawn->at[static_cast<std::size_t>(least - drawn->value.begin())], 0.5 / kFrequency_hz, 0.16);
  EXPECT_NEAR(*least, -kShare * std::exp2(-0.5 / kFrequency_hz / kHalved_s), 0.3 * kShare);
}

}  // namespace
}  // namespace odolab
