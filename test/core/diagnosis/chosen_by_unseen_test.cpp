#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// A robot that drags to one side: forwards that is a matter of its radii, and where it goes back once, in one run, it
// is as if a load had changed them at that moment.
Recording dragging(Random& random, const std::string& name, double forwards_s, double back_s, double bends) {
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 50.0;
  g.inject = [](InjectedStep& s) {
    s.turn_rad += 0.02 * std::abs(0.5 * 0.075 * (s.left_radps + s.right_radps)) * s.dt_s;
  };
  Recording r = generated(
      g,
      [=](double t) {
        const double in_turn_s = std::fmod(t, forwards_s + back_s);
        const double pace = in_turn_s < forwards_s ? 4.0 : -4.0, turn = bends * std::sin(0.4 * t);
        return WheelSpeedsAt{pace * (1.0 - turn), pace * (1.0 + turn)};
      },
      random);
  r.name = name;
  return r;
}

int times_said(const Diagnosis& d, const std::string& effect) {
  return static_cast<int>(std::count_if(d.findings.begin(), d.findings.end(), [&](const Finding& f) {
    return f.effect == effect || std::any_of(f.alternatives.begin(), f.alternatives.end(),
                                             [&](const Alternative& a) { return a.effect == effect; });
  }));
}

TEST(Diagnose, LetsRunsHeldOutChooseBetweenNamesThatTheOthersDoNotTellApart) {
  Random random(71);
  const std::vector<Recording> given = {dragging(random, "run_1", 50.0, 0.0, 0.3),
                                        dragging(random, "run_2", 50.0, 0.0, 0.3),
                                        dragging(random, "run_3", 24.0, 26.0, 0.0)};
  const Recording back_and_forth = dragging(random, "held_out", 5.0, 5.0, 0.3);
  const Diagnosis alone = diagnose(given, {}, Vehicle{}).value();
  EXPECT_EQ(times_said(alone, "one_sided_drag"), 1);
  EXPECT_EQ(times_said(alone, "payload_radius_change"), 1);
  const Diagnosis chosen = diagnose(given, {back_and_forth}, Vehicle{}).value();
  ASSERT_EQ(times_said(chosen, "one_sided_drag"), 1);
  EXPECT_EQ(chosen.findings.front().effect, "one_sided_drag");
  EXPECT_EQ(times_said(chosen, "payload_radius_change"), 0);
}

// Both wheels slip by the vehicle's acceleration. On straights, and in bends at an even pace, that is the same as each
// by its own; where it turns on the spot it is not.
Recording slipping(Random& random, bool spins) {
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01);
  g.duration_s = 40.0;
  const auto was_mps = std::make_shared<double>(0.0);
  g.inject = [was_mps](InjectedStep& s) {
    const double speed_mps = 0.5 * 0.075 * (s.left_radps + s.right_radps), a_mps2 = (speed_mps - *was_mps) / s.dt_s;
    *was_mps = speed_mps;
    s.left_m -= 0.008 * a_mps2 * 0.075 * std::abs(s.left_radps) * s.dt_s;
    s.right_m -= 0.008 * a_mps2 * 0.075 * std::abs(s.right_radps) * s.dt_s;
  };
  return generated(
      g,
      [=](double t) {
        const double pace = 5.0 * std::clamp(1.5 * std::sin(1.2 * t), -1.0, 1.0);
        if (spins) return WheelSpeedsAt{-pace, pace};
        return std::fmod(t, 16.0) < 8.0 ? WheelSpeedsAt{pace, pace} : WheelSpeedsAt{1.5, 2.5};
      },
      random);
}

TEST(Diagnose, LetsRunsHeldOutChooseTheFormOfANameThatTheOthersDoNotTell) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Random random(seed);
    std::vector<Recording> given;
    for (int run = 0; run < 3; ++run) {
      given.push_back(slipping(random, false));
      given.back().name = "run_" + std::to_string(run + 1);
    }
    Recording spins = slipping(random, true);
    spins.name = "held_out";
    const Diagnosis d = diagnose(given, {spins}, Vehicle{}).value();
    ASSERT_EQ(times_said(d, "traction_slip"), 1) << seed;
    const auto slip = std::find_if(d.findings.begin(), d.findings.end(),
                                   [](const Finding& f) { return f.effect == "traction_slip"; });
    ASSERT_NE(slip, d.findings.end());
    EXPECT_EQ(slip->form_in_words, "the vehicle by its acceleration") << seed;
  }
}

}  // namespace
}  // namespace odolab::test
