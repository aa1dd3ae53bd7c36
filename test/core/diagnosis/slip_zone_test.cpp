#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"
#include "test/support/uncalibrated_model.h"

namespace odolab::test {
namespace {

constexpr Vec2 kPlaceOfZone{0.4, 0.4};
constexpr double kZoneRadius_m = 0.3, kSlip = 0.0012;

// Figures of eight whose left circle goes through a patch of floor, faster in each run.
SpeedProfile eights(int run) {
  constexpr double kBend = 0.4;
  const double speed_radps = 4.0 + 0.4 * run, circle_s = kPi * 0.34 / (kBend * speed_radps * 0.075);
  return [=](double t) {
    const double bend = std::fmod(t, 2.0 * circle_s) < circle_s ? kBend : -kBend;
    return WheelSpeedsAt{speed_radps * (1.0 - bend), speed_radps * (1.0 + bend)};
  };
}

// What a wheel loses on the patch, where it lies.
std::function<void(InjectedStep&)> slipping_by(double slip) {
  return [slip](InjectedStep& s) {
    const Vec2 side = rotated({0.0, 0.17}, s.pose.heading_rad);
    if (length(s.pose.position() + side - kPlaceOfZone) < kZoneRadius_m) s.left_m *= 1.0 - slip;
    if (length(s.pose.position() - side - kPlaceOfZone) < kZoneRadius_m) s.right_m *= 1.0 - slip;
  };
}

// It carries a wheel by 0.7 mm at most, where a count is 0.94 mm.
TEST(SlipZone, IsFoundThoughAWheelLosesLessThanACountOnIt) {
  Random random(93);
  DifferentialDrive drive{0.075, 0.075, 0.34};
  drive.encoder_counts_per_revolution = 500.0;
  GeneratorSettings g = under_motion_capture(drive, 0.0002, 0.01);
  g.duration_s = 60.0;
  const auto slipping = [](int) { return slipping_by(kSlip); };
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
  EXPECT_NEAR(d.findings.front().where.zone->x_m, kPlaceOfZone.x_m, 0.2);
  EXPECT_NEAR(d.findings.front().where.zone->y_m, kPlaceOfZone.y_m, 0.2);
}

// Of another program's three runs one went 45 m away, so that patches were sought 1.5 m apart: one of 0.5 m that lost
// 1.2 %, at 43 standard errors, had been six bumps.
TEST(SlipZone, IsSoughtAsCloselyHoweverFarOneOfTheRunsGoes) {
  constexpr double kSmallest_m = 0.25;
  Random random(94);
  const DifferentialDrive drive{0.075, 0.075, 0.34};
  GeneratorSettings g = under_motion_capture(drive, 0.0002, 0.001);
  g.duration_s = 40.0;
  std::vector<Recording> recordings = {generated(g, eights(0), random)};
  g.start = {-2.0, -3.0, 0.5};
  g.duration_s = 80.0;
  recordings.push_back(generated(
      g,
      [](double) {
        return WheelSpeedsAt{6.7, 6.7};
      },
      random));
  Vehicle nominal;
  nominal.kind = drive;
  const JointModel joint = uncalibrated_model(recordings, nominal);
  for (const Effect& e : catalogue()) {
    if (e.name != "slip_zone") continue;
    const std::vector<std::vector<double>> patches = e.scan(joint.views());
    for (const EffectStep& s : joint.views().front().steps) {
      double nearest_m = 1e9;
      for (const std::vector<double>& patch : patches)
        if (patch[2] == kSmallest_m) nearest_m = std::min(nearest_m, length(Vec2{patch[0], patch[1]} - s.position));
      EXPECT_LT(nearest_m, kSmallest_m);
    }
  }
}

}  // namespace
}  // namespace odolab::test
