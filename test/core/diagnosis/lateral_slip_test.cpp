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

}  // namespace
}  // namespace odolab::test
