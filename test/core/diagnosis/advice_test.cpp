#include "core/diagnosis/advice/advice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/diagnosis/diagnosis.h"
#include "test/support/calibrated_model.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Legs driven one after the other, each wheel's speed reached within a third of a second.
SpeedProfile as_driven(const std::vector<DriveLeg>& legs, const DifferentialDrive& believed, double* duration_s) {
  std::vector<WheelSpeedsAt> at;
  constexpr double kStep_s = 0.01;
  double v = 0.0, w = 0.0;
  for (const DriveLeg& leg : legs)
    for (double t = 0.0; t < leg.duration_s; t += kStep_s) {
      v += (leg.speed_mps - v) * kStep_s / 0.1;
      w += (leg.yaw_rate_radps - w) * kStep_s / 0.1;
      const double half = 0.5 * believed.wheelbase_m;
      at.push_back({(v - half * w) / believed.wheel_radius_left_m, (v + half * w) / believed.wheel_radius_right_m});
    }
  *duration_s = kStep_s * static_cast<double>(at.size());
  return [at](double t) {
    const double i = std::clamp(t / kStep_s, 0.0, static_cast<double>(at.size()) - 1.0);
    const auto k = static_cast<std::size_t>(i);
    const WheelSpeedsAt &a = at[k], &b = at[std::min(k + 1, at.size() - 1)];
    const double u = i - static_cast<double>(k);
    return WheelSpeedsAt{a.left_radps + u * (b.left_radps - a.left_radps),
                         a.right_radps + u * (b.right_radps - a.right_radps)};
  };
}

// One robot, 1.3 % and 2 % off its drawing, with an effect of the generator.
Recording driven_along_legs(const std::vector<DriveLeg>& legs, const std::string& effect, double size,
                            std::uint64_t seed) {
  Random random(seed);
  GeneratorSettings g;
  g.drive = {0.0760, 0.0755, 0.347};
  g.wheel_noise = 0.001;
  g.truth_period_s = 0.02;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.002;
  const SpeedProfile profile = as_driven(legs, DifferentialDrive{}, &g.duration_s);
  Random same(1);
  g.inject = injected(effect, size, g.drive, 0, g.duration_s, same);
  Recording r = generated(g, profile, random);
  r.name = "run_" + std::to_string(seed);
  return r;
}

const NotTestable* entry(const Diagnosis& d, const std::string& effect) {
  for (const NotTestable& n : d.not_testable)
    if (n.effect == effect) return &n;
  return nullptr;
}

TEST(Advice, SaysThatStraightsShowNothingOfWhatHappensInTurnsAndSendsIntoTurns) {
  std::vector<DriveLeg> straights;
  for (int k = 0; k < 6; ++k) {
    straights.push_back({5.0, k % 2 == 0 ? 0.3 : -0.3, 0.0});
    straights.push_back({1.0, 0.0, 0.0});
  }
  const Result<Diagnosis> d =
      diagnose({driven_along_legs(straights, "", 0.0, 1), driven_along_legs(straights, "", 0.0, 2)}, {}, Vehicle{});
  ASSERT_TRUE(d);
  for (const char* effect : {"tyre_compression", "turn_scrub", "lateral_slip", "turn_speed_loss"}) {
    const NotTestable* n = entry(*d, effect);
    ASSERT_TRUE(n) << effect;
    EXPECT_FALSE(n->because.empty());
    EXPECT_TRUE(n->drive_this.find("turn") != std::string::npos || n->drive_this.find("arc") != std::string::npos)
        << n->drive_this;
  }
  EXPECT_FALSE(entry(*d, "one_sided_drag"));  // straights both ways do show what drags on one side
  EXPECT_NE(d->next_drive.find("turn"), std::string::npos) << d->next_drive;
  ASSERT_FALSE(d->next_legs.empty());
  EXPECT_TRUE(
      std::any_of(d->next_legs.begin(), d->next_legs.end(), [](const DriveLeg& l) { return l.yaw_rate_radps != 0.0; }));
}

// Bends at one speed and one radius, and turns on the spot at one rate: tyres that are squeezed in bends and wheels
// that grow with their own speed do nearly the same there.
TEST(Advice, ResolvesAPairThatLookedAlikeOnceItIsFollowed) {
  std::vector<DriveLeg> legs;
  for (int k = 0; k < 4; ++k)
    for (double sense : {1.0, -1.0}) {
      legs.push_back({4.0, 0.35, 0.0});
      legs.push_back({4.0, 0.35, sense * 0.7});
      legs.push_back({0.8, 0.0, 0.0});
      legs.push_back({4.0, 0.0, sense * 1.6});
      legs.push_back({0.8, 0.0, 0.0});
    }
  const char* const effect = "tyre_compression";
  std::vector<Recording> recordings = {driven_along_legs(legs, effect, 1.0, 11),
                                       driven_along_legs(legs, effect, 1.0, 12)};
  const Result<Diagnosis> before = diagnose(recordings, {}, Vehicle{});
  ASSERT_TRUE(before);
  ASSERT_EQ(before->verdict, Verdict::ambiguous);
  ASSERT_FALSE(before->next_legs.empty()) << before->next_drive;
  recordings.push_back(driven_along_legs(before->next_legs, effect, 1.0, 13));
  const Result<Diagnosis> after = diagnose(recordings, {}, Vehicle{});
  ASSERT_TRUE(after);
  EXPECT_EQ(after->verdict, Verdict::found);
  ASSERT_EQ(after->findings.size(), 1u);
  EXPECT_EQ(after->findings[0].effect, effect);
  for (const Alternative& a : after->findings[0].alternatives)
    ADD_FAILURE() << a.effect << " " << a.log_likelihood_gain << " of " << after->findings[0].log_likelihood_gain
                  << " after " << before->next_drive;
}

// What drifts through a session, anew in each recording or towards an end, is told apart by drives to come, which begin
// a session of their own: stamps of these days are no drift.
TEST(Advice, IsTheSameWheneverTheLogBegan) {
  const auto entry_of = [](const std::string& effect, const std::string& component) {
    return &*std::find_if(catalogue().begin(), catalogue().end(),
                          [&](const Effect& e) { return e.name == effect && e.component == component; });
  };
  const auto advice_of_log = [&](double begins_s) {
    std::vector<DriveLeg> legs;
    for (int k = 0; k < 6; ++k) legs.insert(legs.end(), {{5.0, 0.3, k % 2 == 0 ? 0.2 : -0.2}, {1.0, 0.0, 0.0}});
    std::vector<Recording> recordings = {driven_along_legs(legs, "radius_drift", 1.0, 21),
                                         driven_along_legs(legs, "radius_drift", 1.0, 22)};
    for (Recording& r : recordings)
      for (double& time_s : r.time_s) time_s += begins_s;
    JointModel joint = calibrated_model(recordings, Vehicle{});
    joint.accepted.push_back({entry_of("radius_drift", "right_wheel"), {begins_s, 0.0}, {1e-4}});
    joint.linearise();
    Confusion confusion;
    confusion.alternative = entry_of("one_sided_drag", "vehicle");
    confusion.value = {0.003};
    return advice(joint, {confusion}, {});
  };
  const Advice at_once = advice_of_log(0.0), these_days = advice_of_log(1.7e9);
  EXPECT_FALSE(at_once.next_legs.empty()) << at_once.next_drive;
  EXPECT_EQ(these_days.next_legs.size(), at_once.next_legs.size()) << these_days.next_drive;
}

}  // namespace
}  // namespace odolab::test
