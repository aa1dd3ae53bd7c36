#include "core/diagnosis/generic/at_rest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kAlways_s = std::numeric_limits<double>::infinity();

// For 3 s ahead, on a curve to either side or in reverse, and for 2 s it stands.
SpeedProfile stops_and_goes(Random& random, double duration_s) {
  constexpr double kLeg_s = 5.0, kGoes_s = 3.0, kFast_radps = 6.0;
  std::vector<WheelSpeedsAt> legs;
  for (double t = 0.0; t < duration_s; t += kLeg_s) {
    const double ahead = random.uniform(-0.5, 1.0), turning = random.uniform(-0.2, 0.2);
    legs.push_back({kFast_radps * (ahead - turning), kFast_radps * (ahead + turning)});
  }
  return [legs](double t) {
    const auto leg = std::min(static_cast<std::size_t>(t / kLeg_s), legs.size() - 1);
    const double since_s = t - kLeg_s * static_cast<double>(leg);
    const double share = since_s < kGoes_s ? 0.5 - 0.5 * std::cos(2.0 * kPi * since_s / kGoes_s) : 0.0;
    return WheelSpeedsAt{share * legs[leg].left_radps, share * legs[leg].right_radps};
  };
}

// While its wheels stand a robot turns at that rate, for so long after each stop.
Diagnosis turning_at_rest(double yaw_rate_radps, double for_s) {
  Random random(67);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0008, 0.02);
  g.duration_s = 60.0;
  const auto turns = [&](int) {
    return [=, stood_s = 0.0](InjectedStep& s) mutable {
      const bool stands = s.left_radps == 0.0 && s.right_radps == 0.0;
      stood_s = stands ? stood_s + s.dt_s : 0.0;
      if (stands && stood_s <= for_s) s.turn_rad += yaw_rate_radps * s.dt_s;
    };
  };
  const auto driving = [&](int) { return stops_and_goes(random, g.duration_s); };
  return diagnose(three_runs(g, random, driving, turns), {}, Vehicle{}).value();
}

TEST(AtRest, AVehicleThatIsShakenRoundWhileItStandsIsUnknown) {
  const Diagnosis d = turning_at_rest(0.01, kAlways_s);
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_NE(d.findings.front().where.regime.find("came to rest"), std::string::npos) << d.findings.front().where.regime;
}

TEST(AtRest, ABrakeThatTurnsItAsItTakesHoldIsUnknown) {
  const Diagnosis d = turning_at_rest(0.05, 0.3);
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_NE(d.findings.front().where.regime.find("came to rest"), std::string::npos) << d.findings.front().where.regime;
}

TEST(AtRest, AVehicleThatStandsAsItStoppedLacksNothing) {
  EXPECT_EQ(turning_at_rest(0.0, kAlways_s).verdict, Verdict::nothing_missing);
}

}  // namespace
}  // namespace odolab::test
