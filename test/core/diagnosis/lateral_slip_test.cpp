#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Figures of eight at one speed each. Slip in proportion to the lateral acceleration is then, to a few centimetres of
// speeding up, slip in proportion to it and to the speed beside a tracked point that sits further back.
TEST(LateralSlip, AtTwoSpeedsNeedsNoPointThatWasMoved) {
  constexpr double kSlip_s = 0.05;
  const DifferentialDrive drive;
  const Vehicle nominal;
  int moved = 0;
  for (const std::uint64_t seed : {7601u, 7602u, 7603u, 7604u}) {
    Random random(seed);
    GeneratorSettings g = under_motion_capture(drive, 0.0005, 0.02);
    g.duration_s = 40.0;
    const auto eight = [&](int run) {
      const double speed = run == 1 ? 4.0 : 8.0;  // rad/s: 0.3 and 0.6 m/s, about circles of 0.8 m
      const double turning = speed * 0.5 * drive.wheelbase_m / 0.8;
      const double once_s = 2.0 * kPi * 0.8 / (speed * drive.wheel_radius_left_m);
      return SpeedProfile([=](double t) {
        const double share = std::min(1.0, t / 0.5), side = std::fmod(t, 2.0 * once_s) < once_s ? 1.0 : -1.0;
        return WheelSpeedsAt{share * (speed - side * turning), share * (speed + side * turning)};
      });
    };
    const std::vector<Recording> runs = three_runs(g, random, eight, [&](int run) {
      return injected("lateral_slip", kSlip_s / 0.02, drive, run, g.duration_s, random);
    });
    const Result<Diagnosis> d = diagnose(runs, {}, nominal);
    ASSERT_TRUE(d);
    ASSERT_FALSE(d->findings.empty());
    EXPECT_EQ(d->findings.front().effect, "lateral_slip") << seed;
    for (const Finding& f : d->findings) moved += f.effect == "truth_mounting_offset";
    EXPECT_NEAR(d->findings.front().parameters.front().value, kSlip_s, 0.1 * kSlip_s) << seed;
  }
  EXPECT_EQ(moved, 0);
}

// A tyre that slips at an angle does so at a speed that grows with its own: at a tenth of a metre a second by a tenth
// of what it is at one.
TEST(LateralSlip, AtAnAngleIsSaidAsLargeAsItIsAtTheSpeedsDriven) {
  constexpr double kAngle_per_mps2 = 0.15;
  const DifferentialDrive drive;
  Random random(7605);
  GeneratorSettings g = under_motion_capture(drive, 0.0002, 0.01);
  g.duration_s = 60.0;
  const auto eight = [&](int run) {
    const double speed = 1.0 + 0.5 * run;  // rad/s: 0.08 to 0.15 m/s, about circles of 0.2 m
    return SpeedProfile([=](double t) {
      const double turning = (std::fmod(t, 30.0) < 15.0 ? 1.0 : -1.0) * speed * 0.5 * drive.wheelbase_m / 0.2;
      const double share = std::min(1.0, t / 0.5) * (std::fmod(t, 7.0) < 4.0 ? 1.0 : 0.4);
      return WheelSpeedsAt{share * (speed - turning), share * (speed + turning)};
    });
  };
  double slipped = 0.0, by_acceleration = 0.0;  // of its outward speed on the acceleration, by least squares
  const auto slipping = [&](int) {
    return [&](InjectedStep& s) {
      const double v = 0.5 * (s.left_m + s.right_m) / s.dt_s, w = (s.right_m - s.left_m) / s.dt_s / drive.wheelbase_m,
                   outward_mps = kAngle_per_mps2 * std::abs(v) * v * w;
      s.sideways_m -= outward_mps * s.dt_s;
      slipped += outward_mps * v * w, by_acceleration += v * w * v * w;
    };
  };
  const Diagnosis d = diagnose(three_runs(g, random, eight, slipping), {}, Vehicle{}).value();
  ASSERT_FALSE(d.findings.empty());
  ASSERT_EQ(d.findings.front().effect, "lateral_slip");
  const FoundParameter& p = d.findings.front().parameters.front();
  EXPECT_NEAR(p.value, slipped / by_acceleration, 3.0 * p.stderr_value);
  EXPECT_LT(p.stderr_value, 0.2 * p.value);
}

}  // namespace
}  // namespace odolab::test
