#include "core/diagnosis/generic/uneven_wheels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

test::Case three_runs_with(const std::string& effect, double size) {
  test::CaseSettings settings;
  settings.effect = effect;
  settings.size = size;
  settings.runs = 3;
  settings.duration_s = 50.0;
  return test::generated_case(settings, 4);
}

bool says_that_it_comes_and_goes(const Diagnosis& d) {
  return std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("way of the left wheel comes and goes 2.5 times a turn") != std::string::npos;
  });
}

TEST(UnevenWheels, LeaveANameItsPlaceBesideAGearThatAddsUpToNothing) {
  const test::Case c = three_runs_with("gear_and_push", 1.5);
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::found);
  EXPECT_EQ(d->findings.front().effect, "collision");
  EXPECT_TRUE(says_that_it_comes_and_goes(*d));
}

TEST(UnevenWheels, AreUnknownByAGearWhereNoNameStands) {
  const test::Case c = three_runs_with("gear", 3.0);
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_EQ(d->findings.front().where.regime,
            "way of the left wheel per metre [1] that depends on its angle, 2.5 times a turn");
}

// Tags 25 times a second, by which no metre is driven better with the lobes than without.
TEST(UnevenWheels, AreUnknownByAFlatThatResemblesOneOutOfRound) {
  Random random(67);
  test::GeneratorSettings g = test::under_motion_capture({0.08, 0.08, 0.45}, 0.0008, 0.04);
  g.duration_s = 60.0;
  g.truth_position_noise_m = 0.004;
  g.truth_heading_noise_rad = 0.009;
  const auto flat = [](int run) {
    return [run](test::InjectedStep& s) {
      const double from_flat_rad = std::remainder(s.right_rad - run, 2.0 * kPi);
      s.right_m *= 1.0 - 0.15 * std::exp(-0.5 * std::pow(from_flat_rad / 0.25, 2));
    };
  };
  const Result<Diagnosis> d =
      diagnose(test::three_runs(
                   g, random, [&](int) { return test::varied_driving(random, g.duration_s); }, flat),
               {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  const Finding& unknown = d->findings.front();
  EXPECT_EQ(unknown.where.regime.find("way of the right wheel per metre [1] that depends on its angle"), 0u)
      << unknown.where.regime;
  EXPECT_NE(unknown.where.regime.find("its angle, once a turn, over about "), std::string::npos)
      << unknown.where.regime;
  EXPECT_EQ(d->next_drive, "a look at the right wheel while it is turned by hand");
  ASSERT_FALSE(unknown.alternatives.empty());
  EXPECT_EQ(unknown.alternatives.front().effect, "wheel_eccentricity");
  EXPECT_EQ(unknown.alternatives.front().component, "right_wheel");
}

// A wheel that is a little out of round behind a gear that errs by twice as much, and takes it nowhere: a real robot's
// right wheel is so.
TEST(UnevenWheels, AreOutOfRoundBesideTheirOwnGear) {
  Random random(68);
  test::GeneratorSettings g = test::under_motion_capture({0.042, 0.042, 0.2}, 0.0008, 0.02);
  g.duration_s = 60.0;
  const auto turns = [](int run) {
    return [run](test::InjectedStep& s) {
      s.right_m *= 1.0 + 0.006 * std::sin(s.right_rad) + 0.012 * std::sin(2.5 * s.right_rad + run);
    };
  };
  const Result<Diagnosis> d =
      diagnose(test::three_runs(
                   g, random, [&](int) { return test::varied_driving(random, g.duration_s); }, turns),
               {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::found) << d->findings.front().where.regime;
  EXPECT_EQ(d->findings.front().effect, "wheel_eccentricity");
  EXPECT_EQ(d->findings.front().component, "right_wheel");
}

// A belt that is thick at one place, and goes round once in 2.7 turns of its wheel.
TEST(UnevenWheels, AreUnknownByABeltThatGoesRoundMoreSlowlyThanItsWheel) {
  Random random(66);
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01);
  g.duration_s = 60.0;
  const auto thick = [](int run) {
    return [run](test::InjectedStep& s) { s.left_m *= 1.0 + 0.01 * std::sin(s.left_rad / 2.7 + run); };
  };
  const Result<Diagnosis> d =
      diagnose(test::three_runs(
                   g, random, [&](int) { return test::varied_driving(random, g.duration_s); }, thick),
               {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_EQ(d->findings.front().component, "left_wheel");
  const std::string& regime = d->findings.front().where.regime;
  EXPECT_EQ(regime.find("way of the left wheel per metre [1] that depends on its angle, 0.37"), 0u) << regime;
}

}  // namespace
}  // namespace odolab
