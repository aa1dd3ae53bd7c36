#include "core/diagnosis/quality/sound_recordings.h"

#include <gtest/gtest.h>

#include "test/support/missing_physics.h"
#include "test/support/other_clock.h"

namespace odolab {
namespace {

Vehicle drawn_robot() {
  Vehicle v;
  v.kind = DifferentialDrive{0.1, 0.1, 0.45};
  return v;
}

// A robot that stops at once for three seconds and goes on as before, under a truth that is late by half of that. Its
// left encoder may stand still for a while.
Recording resting_under_late_truth(double stands_from_s, double stands_to_s) {
  test::GeneratorSettings g = test::under_motion_capture({0.0996, 0.1003, 0.4565}, 0.0005, 0.05);
  g.duration_s = 60.0;
  Random random(8);
  const test::SpeedProfile driving = test::varied_driving(random, g.duration_s);
  g.inject = [=](test::InjectedStep& step) {
    if (step.time_s > stands_from_s && step.time_s < stands_to_s) step.left_read_rad = 0.0;
  };
  const auto with_a_rest = [&](double t) {
    return t > 30.0 && t < 33.0 ? test::WheelSpeedsAt{}
                                : test::WheelSpeedsAt{4.0 + driving(t).left_radps, 4.0 + driving(t).right_radps};
  };
  Recording r = test::with_truths_clock(generated(g, with_a_rest, random), 1.5, 0.0);
  r.name = "late.csv";
  return r;
}

TEST(SoundRecordings, RestWhereALateTruthDrivesOn) {
  const SoundRecordings sound = sound_recordings({resting_under_late_truth(0.0, 0.0)}, drawn_robot());
  EXPECT_TRUE(sound.said.empty()) << sound.said.front();
}

TEST(SoundRecordings, AreWithoutAnEncoderThatStandsThoughTheTruthIsLate) {
  const SoundRecordings sound = sound_recordings({resting_under_late_truth(40.0, 44.0)}, drawn_robot());
  ASSERT_EQ(sound.said.size(), 1u);
  EXPECT_NE(sound.said[0].find("late.csv from 40.0 to 44.0 s: the left encoder stands still"), std::string::npos)
      << sound.said[0];
}

}  // namespace
}  // namespace odolab
