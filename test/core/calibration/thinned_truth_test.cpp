#include "core/calibration/thinned_truth.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

// One wheel rolls at 0.1 m/s while the other stands; the truth comes every 0.01 s.
InnovationRun pivot() {
  InnovationRun run;
  for (int i = 0; i <= 1000; ++i) run.wheels.push_back({0.01 * i, 0.0, 0.01 * i});
  for (int i = 0; i <= 1000; ++i) run.truth.push_back({0.01 * i, {}, 0.0});
  run.set_aside.assign(run.truth.size(), 0);
  return run;
}

InnovationModel wheels_of_a_tenth() {
  InnovationModel model;
  model.drive = {0.1, 0.1, 0.4};
  return model;
}

ThinnedTruth thinned(const InnovationRun& run) {
  const InnovationModel model = wheels_of_a_tenth();
  return thinned_truth(run, summed_up(run, model), model, 0.1);
}

TEST(ThinnedTruth, KeepsSamplesATenthOfAMetreOfTheFasterWheelApart) {
  const InnovationRun thin = thinned(pivot()).run;
  // 1 m in all: the first sample and ten behind it, each of them 1 s later; a sample late where rounding has it so.
  ASSERT_NEAR(static_cast<double>(thin.truth.size()), 11.0, 1.0);
  ASSERT_EQ(thin.set_aside.size(), thin.truth.size());
  for (std::size_t i = 1; i < thin.truth.size(); ++i)
    EXPECT_NEAR(thin.truth[i].time_s - thin.truth[i - 1].time_s, 1.0, 0.011);
}

TEST(ThinnedTruth, PassesOverWhatIsSetAsideAndKeepsWhereARunBeginsAnew) {
  InnovationRun run = pivot();
  run.set_aside[100] = 1;
  run.set_aside[350] = 2;
  const InnovationRun thin = thinned(run).run;
  bool begins = false;
  for (std::size_t i = 0; i < thin.truth.size(); ++i) {
    EXPECT_NE(thin.truth[i].time_s, 1.0);
    EXPECT_NE(thin.set_aside[i], 1);
    begins = begins || (thin.set_aside[i] == 2 && thin.truth[i].time_s == 3.5);
  }
  EXPECT_TRUE(begins);
}

// A curve with body noise: motions and variances put together are those summed up over the longer way.
TEST(ThinnedTruth, SumsUpWhatTheWheelsDidAsIfTheOtherSamplesHadNotBeen) {
  InnovationRun run = pivot();
  for (WheelSample& w : run.wheels) w.left_rad = 0.3 * w.right_rad * w.right_rad;
  InnovationModel model = wheels_of_a_tenth();
  model.noise.along_m_per_sqrt_m = model.noise.turning_m_per_sqrt_m = 0.001;
  const ThinnedTruth thin = thinned_truth(run, summed_up(run, model), model, 0.1);
  const SummedRun whole = [&] {
    InnovationRun only = run;
    only.truth = thin.run.truth;
    return summed_up(only, model);
  }();
  ASSERT_EQ(thin.summed.motions.size(), whole.motions.size());
  constexpr double kRounding = 1e-12;  // metres, radians and variances of order one
  for (std::size_t i = 0; i < whole.motions.size(); ++i) {
    const RelativeMotion &a = thin.summed.motions[i], &b = whole.motions[i];
    EXPECT_NEAR(a.motion.x_m, b.motion.x_m, kRounding);
    EXPECT_NEAR(a.motion.y_m, b.motion.y_m, kRounding);
    EXPECT_NEAR(a.motion.heading_rad, b.motion.heading_rad, kRounding);
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(a.wheel_noise[k], b.wheel_noise[k], kRounding);
      EXPECT_NEAR(a.along_noise[k], b.along_noise[k], kRounding);
      EXPECT_NEAR(a.turning_noise[k], b.turning_noise[k], kRounding);
      EXPECT_NEAR(a.sideways_noise[k], b.sideways_noise[k], kRounding);
    }
  }
}

}  // namespace
}  // namespace odolab
