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

TEST(ThinnedTruth, KeepsSamplesATenthOfAMetreOfTheFasterWheelApart) {
  const InnovationRun thin = thinned_truth(pivot(), wheels_of_a_tenth(), 0.1);
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
  const InnovationRun thin = thinned_truth(run, wheels_of_a_tenth(), 0.1);
  bool begins = false;
  for (std::size_t i = 0; i < thin.truth.size(); ++i) {
    EXPECT_NE(thin.truth[i].time_s, 1.0);
    EXPECT_NE(thin.set_aside[i], 1);
    begins = begins || (thin.set_aside[i] == 2 && thin.truth[i].time_s == 3.5);
  }
  EXPECT_TRUE(begins);
}

}  // namespace
}  // namespace odolab
