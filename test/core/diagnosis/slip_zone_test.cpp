#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr Vec2 kPlace{0.4, 0.4};
constexpr double kRadius_m = 0.3, kSlip = 0.0012;

// Figures of eight whose left circle goes through a patch of floor, faster in each run.
SpeedProfile eights(int run) {
  constexpr double kBend = 0.4;
  const double speed_radps = 4.0 + 0.4 * run, circle_s = kPi * 0.34 / (kBend * speed_radps * 0.075);
  return [=](double t) {
    const double bend = std::fmod(t, 2.0 * circle_s) < circle_s ? kBend : -kBend;
    return WheelSpeedsAt{speed_radps * (1.0 - bend), speed_radps * (1.0 + bend)};
  };
}

// It carries a wheel by 0.7 mm at most, where a count is 0.94 mm.
TEST(SlipZone, IsFoundThoughAWheelLosesLessThanACountOnIt) {
  Random random(93);
  DifferentialDrive drive{0.075, 0.075, 0.34};
  drive.encoder_counts_per_revolution = 500.0;
  GeneratorSettings g = under_motion_capture(drive, 0.0002, 0.01);
  g.duration_s = 60.0;
  const auto slipping = [](int) {
    return [](InjectedStep& s) {
      const Vec2 side = rotated({0.0, 0.17}, s.pose.heading_rad);
      if (length(s.pose.position() + side - kPlace) < kRadius_m) s.left_m *= 1.0 - kSlip;
      if (length(s.pose.position() - side - kPlace) < kRadius_m) s.right_m *= 1.0 - kSlip;
    };
  };
  Vehicle nominal;
  nominal.kind = drive;
  const Diagnosis d = diagnose(three_runs(g, random, eights, slipping), {}, nominal).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().effect, "slip_zone");
  for (const FoundParameter& p : d.findings.front().parameters)
    if (p.name == "slip") {
      EXPECT_LT(std::abs(p.value - kSlip), 3.0 * p.stderr_value);
    }
  ASSERT_TRUE(d.findings.front().where.zone);
  EXPECT_NEAR(d.findings.front().where.zone->x_m, kPlace.x_m, 0.2);
  EXPECT_NEAR(d.findings.front().where.zone->y_m, kPlace.y_m, 0.2);
}

}  // namespace
}  // namespace odolab::test
