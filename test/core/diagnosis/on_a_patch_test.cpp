#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr Vec2 kPlace{0.0, 0.7};  // before a wall along x
constexpr double kNear_m = 0.4;

// Figures of eight, each faster than the one before; every other sets out backwards in the room, so that what lies to
// the left of the start is passed one way round by one and the other way round by the next.
std::vector<Recording> eights_past(const std::function<void(InjectedStep&)>& at_the_place) {
  Random random(67);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.05);
  g.duration_s = 60.0;
  g.inject = [&](InjectedStep& s) {
    if (length(s.pose.position() - kPlace) < kNear_m) at_the_place(s);
  };
  std::vector<Recording> recordings;
  for (int run = 0; run < 4; ++run) {
    constexpr double kBend = 0.35;
    const double speed_radps = 4.0 + 0.4 * run, circle_s = kPi * 0.34 / (kBend * speed_radps * 0.075);
    g.start = {0.02 * run, 0.01 * run, run % 2 == 0 ? 0.0 : kPi};
    recordings.push_back(generated(
        g,
        [=](double t) {
          const double bend = std::fmod(t, 2.0 * circle_s) < circle_s ? kBend : -kBend;
          return WheelSpeedsAt{speed_radps * (1.0 - bend), speed_radps * (1.0 + bend)};
        },
        random));
    recordings.back().name = "run_" + std::to_string(run + 1);
  }
  return recordings;
}

Diagnosis diagnosed_past(const std::function<void(InjectedStep&)>& at_the_place) {
  return diagnose(eights_past(at_the_place), {}, Vehicle{}).value();
}

TEST(OnAPatch, IsNoSlipWhereAScannerSlowsWhatHeadsForTheWall) {
  const Diagnosis d = diagnosed_past([](InjectedStep& s) {
    const double by = 0.02 * std::max(0.0, std::sin(s.pose.heading_rad));
    s.left_m *= 1.0 - by;
    s.right_m *= 1.0 - by;
  });
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  const WhereFound& where = d.findings.front().where;
  EXPECT_NE(where.regime.find("heading on the slip zone"), std::string::npos) << where.regime;
  ASSERT_TRUE(where.zone);
  EXPECT_LT(length(Vec2{where.zone->x_m, where.zone->y_m} - kPlace), kNear_m);
}

TEST(OnAPatch, IsSlipWhereAllThatDrivesThereLosesAlike) {
  const Diagnosis d = diagnosed_past([](InjectedStep& s) {
    s.left_m *= 0.98;
    s.right_m *= 0.98;
  });
  ASSERT_EQ(d.verdict, Verdict::found);
  EXPECT_EQ(d.findings.front().effect, "slip_zone");
}

}  // namespace
}  // namespace odolab::test
