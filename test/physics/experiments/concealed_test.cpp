#include <gtest/gtest.h>

#include <cmath>

#include "physics/experiments/concealed/drawn_case.h"
#include "physics/experiments/concealed/oracle.h"
#include "physics/experiments/concealed/report.h"
#include "physics/experiments/concealed/tally.h"

namespace odolab::concealed {
namespace {

// Half a minute of straight and back, in reverse.
RunPlan short_run(const ActiveEffect& effect) {
  Random random(7);
  RunPlan plan;
  plan.robot = drawn_robot(random, true);
  plan.drive.name = "there_and_back";
  plan.drive.path = StraightPath{3.0, true};
  plan.drive.driving = {0.3, 1.0, 0.5, 1.0};
  plan.effects.push_back({.active = effect, .amplitudes = {}});
  plan.seed = 5;
  return plan;
}

BodyMotion sum_of(const std::vector<BodyMotion>& steps) {
  BodyMotion sum;
  for (const BodyMotion& m : steps)
    sum = {sum.forward_m + m.forward_m, sum.sideways_m + m.sideways_m, sum.turn_rad + m.turn_rad};
  return sum;
}

TEST(ConcealedDrivenRun, DifferenceIsWhatTheEffectDoesAndNoneOfTheNoise) {
  const RunPlan plan = short_run({"one_sided_drag", "vehicle", {{"rad_per_m", 0.02}}});
  const DrivenRun run = driven(plan);
  RunPlan without = plan;
  without.effects.clear();
  const Track track = driven_again(without, run.counted);
  std::vector<WheelSample> wheels;
  for (std::size_t i = 0; i < run.counted.size(); i += 20) wheels.push_back(run.counted[i]);
  const BodyMotion sum = sum_of(difference(wheels, {run.true_axle, 0.0}, {track, 0.0}));
  // 6 m at 0.02 rad/m, with the machine's radii 2 % off its drawing and a driver that ends within a millimetre.
  EXPECT_NEAR(sum.turn_rad, 0.12, 0.004);
  EXPECT_NEAR(sum.forward_m, 0.0, 1e-4);  // the way is the same to the friction's creep
}

TEST(ConcealedDrivenRun, AClockThatRunsFastMovesTheStampsAlone) {
  const RunPlan plan = short_run({"clock_rate", "vehicle", {{"rate", 0.01}}});
  const DrivenRun run = driven(plan);
  EXPECT_EQ(plan.clock_rate(), 0.01);
  const std::vector<WheelSample> wheels = wheel_samples(run.recording, plan.robot.nominal());
  EXPECT_NEAR(wheels.back().time_s, 1.01 * run.true_axle.back().time_s, 0.03);  // one encoder period, 25 ms at most
  const BodyMotion sum = sum_of(difference(wheels, {run.true_axle, 0.0}, {run.true_axle, 0.01}));
  EXPECT_NEAR(sum.forward_m, 0.0, 0.002);  // the run begins and ends at rest: nothing is lost, only shifted
}

TEST(ConcealedDrivenRun, ErrsAlikeWithOneSeedAndOtherwiseWithAnother) {
  RunPlan plan = short_run({"one_sided_drag", "vehicle", {{"rad_per_m", 0.02}}});
  const DrivenRun a = driven(plan), b = driven(plan);
  plan.seed = 6;
  const DrivenRun other = driven(plan);
  EXPECT_EQ(a.recording.time_s, b.recording.time_s);
  EXPECT_EQ(a.true_axle.back().pose.x_m, b.true_axle.back().pose.x_m);
  EXPECT_NE(a.true_axle.back().pose.x_m, other.true_axle.back().pose.x_m);
}

TEST(ConcealedTally, HasWilsonsInterval) {
  const Tally all{10, 10}, none{0, 300};
  EXPECT_NEAR(all.low(), 0.7225, 1e-4);  // n / (n + z^2)
  EXPECT_NEAR(all.high(), 1.0, 1e-12);
  EXPECT_NEAR(none.high(), 0.01264, 1e-5);  // z^2 / (n + z^2)
  EXPECT_NEAR(none.low(), 0.0, 1e-12);
}

Judged of(Kind kind, Verdict verdict) {
  Judged j;
  j.kind = kind;
  j.verdict = verdict;
  j.concealed.under_noise = true;
  return j;
}

TEST(ConcealedReport, CountsAnAlarmOnNothingAsAClaimThatDoesNotHold) {
  std::vector<Judged> cases(20, of(Kind::nothing, Verdict::nothing_missing));
  EXPECT_TRUE(report_of(cases).claims.front().holds);
  cases[3].verdict = Verdict::unknown_effect;
  const ExperimentReport report = report_of(cases);
  EXPECT_FALSE(report.claims.front().holds);  // 1 of 20 is 5 %, and 3 % is the bar
  EXPECT_FALSE(report.claims.front().explained);
}

// On squares a radius that depends on speed is all but another radius: a share of missed counts above a speed between
// the two that are driven fits what its form is off, and beside it, wherever that speed is, the radius could be
// anything.
TEST(ConcealedCase, ANameIsNotGivenUpForAWeakerOneThatMadeItsSizeUncertain) {
  Wish wish;
  wish.kind = Kind::one;
  wish.level = Level::medium;
  const Judged j = judged(drawn_case(3028, 24, wish));
  ASSERT_EQ(j.truth, std::vector<std::string>{"speed_dependent_radius.right_wheel"});
  EXPECT_EQ(j.found, j.truth);
  for (const JudgedParameter& p : j.parameters) EXPECT_NEAR(p.found, p.truth, 3.0 * p.stderr_value) << p.name;
}

// Wheels that slip by a tenth for each m/s2 hold the vehicle back: it speeds up later than they do. In squares, with
// starts and stops and turns on the spot, what it stays behind by had been a second name in six of ten such drives.
TEST(ConcealedCase, ATractionSlipThatHoldsTheVehicleBackNeedsNoSecondName) {
  Wish wish;
  wish.kind = Kind::one;
  wish.level = Level::strong;
  wish.poor = true;
  wish.effects = {"traction_slip"};
  const Judged j = judged(drawn_case(700, 18, wish));
  EXPECT_TRUE(j.named_all && j.only_those) << j.line();
  ASSERT_FALSE(j.parameters.empty());
  EXPECT_TRUE(j.parameters.front().held()) << j.line();
}

// A wheel that climbs 16 mm further than it travels, in squares: what the scan asks says next to nothing of it, since
// the truth contradicts the wheels for so long that nobody hears of the moments at which it is met.
TEST(ConcealedCase, ALargeBumpIsFoundWhereThePatchInItsPlaceIs) {
  Wish wish;
  wish.kind = Kind::one;
  wish.level = Level::strong;
  wish.poor = true;
  const Judged j = judged(drawn_case(3060, 13, wish));
  ASSERT_EQ(j.truth, std::vector<std::string>{"bump.right_wheel"});
  EXPECT_TRUE(j.named_all && j.only_those) << j.line();
  for (const JudgedParameter& p : j.parameters) EXPECT_NEAR(p.found, p.truth, 3.0 * p.stderr_value) << p.name;
}

TEST(ConcealedCase, ABumpIsOneThingThoughAWheelAlsoMeetsItsEdge) {
  Wish wish;
  wish.kind = Kind::one;
  const Judged j = judged(drawn_case(5, 0, wish));
  ASSERT_EQ(j.truth, std::vector<std::string>{"bump.right_wheel"});
  EXPECT_TRUE(j.named_first) << j.line();
  for (const JudgedParameter& p : j.parameters) EXPECT_NEAR(p.found, p.truth, 3.0 * p.stderr_value) << p.name;
}

}  // namespace
}  // namespace odolab::concealed
