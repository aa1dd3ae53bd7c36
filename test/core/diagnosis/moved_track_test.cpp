#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Three runs, in the second of which something shoves the robot along the room's x axis.
Diagnosis of_a_push(double push_m) {
  Random random(21);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0005, 0.01);
  g.duration_s = 40.0;
  return diagnose(three_runs(
                      g, random, [&](int) { return varied_driving(random, 40.0); },
                      [=](int run) -> std::function<void(InjectedStep&)> {
                        return [=](InjectedStep& s) {
                          if (run == 1 && std::abs(s.time_s - 17.0) < 0.05) s.room_m.x_m += push_m * s.dt_s / 0.1;
                        };
                      }),
                  {}, Vehicle{})
      .value();
}

TEST(MovedTrack, IsMovedByAPushAsFarAsThatPushes) {
  constexpr double kPush_m = 0.03;
  const Diagnosis d = of_a_push(kPush_m);
  ASSERT_EQ(d.findings.size(), 1u);
  const Finding& f = d.findings.front();
  ASSERT_EQ(f.effect, "collision");
  ASSERT_TRUE(f.moves.has_value());
  // Four standard errors of a push that is one stretch's alone, whatever the hundred other stretches are.
  EXPECT_NEAR(f.moves->position_rms_m, kPush_m, 4.0 * f.parameters[0].stderr_value);
  EXPECT_LT(f.moves->heading_rms_rad, 4.0 * f.parameters[2].stderr_value);
}

TEST(MovedTrack, IsOfTheMotionAlone) {
  // The truth's clock is late; a robot that is not seen in time is not moved.
  CaseSettings settings;
  settings.duration_s = 30.0;
  settings.truth_late_s = 0.08;
  const Case c = generated_case(settings, 5);
  const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
  ASSERT_FALSE(d.findings.empty());
  for (const Finding& f : d.findings) EXPECT_FALSE(f.moves.has_value()) << f.effect;
}

}  // namespace
}  // namespace odolab::test
