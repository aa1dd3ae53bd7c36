#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kWheelRadius_m = 0.075;

// To and fro, each way with a bend, at top speeds and accelerations of its own.
SpeedProfile shuttle(int run) {
  return [=](double t) {
    const int leg = static_cast<int>(t / 10.0);
    const double in_leg_s = t - 10.0 * leg, mps2 = 0.3 + 0.2 * ((leg / 2 + run) % 4), most_mps = 0.3 + 0.1 * (leg % 3);
    const double speed_mps = std::clamp(mps2 * std::min(in_leg_s, 8.0 - in_leg_s), 0.0, most_mps);
    const double way = (leg % 2 == 0 ? speed_mps : -speed_mps) / kWheelRadius_m;
    const double turns = in_leg_s < 8.0 ? (1.0 + 0.5 * run) * std::sin(2.0 * kPi * in_leg_s / 8.0) : 0.0;
    return WheelSpeedsAt{way - turns, way + turns};
  };
}

Diagnosis of_shuttles(const std::function<void(InjectedStep&)>& what_happens) {
  Random random(81);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.02);
  g.duration_s = 80.0;
  return diagnose(three_runs(g, random, shuttle, [&](int) { return what_happens; }), {}, Vehicle{}).value();
}

void expect_unknown(const Diagnosis& d, const char* regime) {
  ASSERT_EQ(d.verdict, Verdict::unknown_effect) << d.findings.front().effect;
  EXPECT_NE(d.findings.front().where.regime.find(regime), std::string::npos) << d.findings.front().where.regime;
}

// Locked wheels skid on, driven ones grip: half of that is a traction slip, and had been called one.
TEST(OneWay, IsHowWheelsSlipThatSkidWhereTheyBrakeAlone) {
  auto before_mps = std::make_shared<double>(0.0);
  const Diagnosis d = of_shuttles([=](InjectedStep& s) {
    const double speed_mps = 0.5 * (s.left_m + s.right_m) / s.dt_s;
    if (s.time_s == 0.0) *before_mps = speed_mps;
    const double braking_mps2 = -(std::abs(speed_mps) - std::abs(*before_mps)) / s.dt_s;
    *before_mps = speed_mps;
    const double skids = 0.06 * std::max(braking_mps2, 0.0);
    s.left_m *= 1.0 + skids, s.right_m *= 1.0 + skids;
  });
  expect_unknown(d, "where it brakes alone");
}

// A tread with a direction: a wheel's radius is 1 % larger in reverse. What turns the vehicle in reverse alone had been
// a drag that keeps its side.
TEST(OneWay, IsHowAWheelRollsWhoseTreadHasADirection) {
  const Diagnosis d = of_shuttles([](InjectedStep& s) {
    if (s.right_radps < 0.0) s.right_m *= 1.01;
  });
  expect_unknown(d, "in reverse alone");
  EXPECT_EQ(d.findings.front().component, "right_wheel");
}

}  // namespace
}  // namespace odolab::test
