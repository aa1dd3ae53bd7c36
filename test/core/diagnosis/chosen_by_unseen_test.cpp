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

int said(const Diagnosis& d, const std::string& effect) {
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
  EXPECT_EQ(said(alone, "one_sided_drag"), 1);
  EXPECT_EQ(said(alone, "payload_radius_change"), 1);
  const Diagnosis chosen = diagnose(given, {back_and_forth}, Vehicle{}).value();
  ASSERT_EQ(said(chosen, "one_sided_drag"), 1);
  EXPECT_EQ(chosen.findings.front().effect, "one_sided_drag");
  EXPECT_EQ(said(chosen, "payload_radius_change"), 0);
}

}  // namespace
}  // namespace odolab::test
