#include "core/recording/truth_left_out.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

TEST(TruthLeftOut, IsGoneInMarkedRowsAndNothingElseIs) {
  Recording r;
  r.time_s = {0.0, 1.0, 2.0};
  r.channels = {{"left_wheel_rad", {0.0, 1.0, 2.0}},
                {"truth_x_m", {0.0, 0.1, 0.2}},
                {"truth_y_m", {0.3, 0.4, 0.5}},
                {"truth_heading_rad", {0.6, 0.7, 0.8}},
                {"true_love", {1.0, 1.0, 1.0}}};
  leave_truth_out(r, {0, 1, 0});
  const std::vector<TruthSample> truth = truth_samples(r);
  ASSERT_EQ(truth.size(), 2u);
  EXPECT_EQ(truth[0].time_s, 0.0);
  EXPECT_EQ(truth[1].time_s, 2.0);
  EXPECT_TRUE(std::isnan(r.channel("truth_heading_rad")->values[1]));
  EXPECT_EQ(r.channel("left_wheel_rad")->values[1], 1.0);
  EXPECT_EQ(r.channel("true_love")->values[1], 1.0);
}

}  // namespace
}  // namespace odolab
