#include "core/diagnosis/generic/unlike_recordings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

TEST(UnlikeRecordings, AreTheFewerBesideTheWidestGap) {
  const auto one = unlike_recordings({0.001, 0.0, 0.081, 0.002});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->which, (std::vector<std::size_t>{2}));
  EXPECT_NEAR(one->more, 0.08, 1e-12);
  EXPECT_EQ(in_words(*one, {"a", "b", "c", "d"}, false), "c, 8 % more than the others");
}

TEST(UnlikeRecordings, AreTheLaterWhereBothSidesAreAsMany) {
  const auto later = unlike_recordings({0.031, 0.03, 0.0, 0.001});
  ASSERT_TRUE(later);
  EXPECT_EQ(later->which, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(in_words(*later, {"a", "b", "c", "d"}, false), "c and d, 3 % less than the others");
  EXPECT_FALSE(unlike_recordings({0.5}));
}

// Wheels 2 and 3 % larger and a wheelbase 7 % shorter in the last run: other tyres, or another robot. A load says most
// of it, and dead reckoning by it errs by four times what noise does.
TEST(UnlikeRecordings, AreSomethingWithoutANameThoughALoadSaysMostOfIt) {
  Random random(91);
  GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 0.0005, 0.02);
  g.truth_position_noise_m = 0.0003;
  g.truth_heading_noise_rad = 0.0005;
  g.duration_s = 50.0;
  std::vector<Recording> runs;
  for (int run = 0; run < 4; ++run) {
    const auto profile = [run](double t) {  // eights, each run of other bends
      const double forward = 4.0 + 1.5 * std::sin(0.5 * t), bend = (0.7 + 0.2 * run) * std::sin((0.4 + 0.05 * run) * t);
      return WheelSpeedsAt{forward - bend, forward + bend};
    };
    if (run == 3) {
      g.drive.wheel_radius_left_m *= 1.02;
      g.drive.wheel_radius_right_m *= 1.03;
      g.drive.wheelbase_m *= 0.93;
    }
    runs.push_back(generated(g, profile, random));
    runs.back().name = "run_" + std::to_string(run + 1);
  }
  const Diagnosis d = diagnose(runs, {}, Vehicle{}).value();
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  const std::string& regime = d.findings.front().where.regime;
  EXPECT_NE(regime.find("recording (run_4, "), std::string::npos) << regime;
}

}  // namespace
}  // namespace odolab::test
