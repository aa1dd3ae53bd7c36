#include "core/diagnosis/place_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

// There and back along x, 8 m at 0.5 m/s, 50 Hz: white noise, and between x = 3 and 4 m a turn on top of it.
Residuals there_and_back(double turn_rad) {
  Residuals r;
  r.recording = "run.csv";
  Random noise(7);
  for (int i = 0; i < 1600; ++i) {
    const double t = 0.02 * i, s = 0.5 * t, x = s < 8.0 ? s : 16.0 - s;
    r.time_s.push_back(t);
    r.x_m.push_back(x);
    r.y_m.push_back(0.0);
    r.along_m.push_back(0.001 * noise.normal());
    r.across_m.push_back(0.001 * noise.normal());
    r.heading_rad.push_back(0.002 * noise.normal() + (x > 3.0 && x < 4.0 ? turn_rad : 0.0));
    r.squared.push_back(1.0);
  }
  return r;
}

TEST(PlaceResponse, StandsOutWhereTheMismatchIsAndNowhereElse) {
  const std::vector<Response> all = place_responses({there_and_back(0.001)}, {there_and_back(0.0)}, true);
  ASSERT_EQ(all.size(), 3u);  // turn, forward and sideways over x; nothing went along y
  const Response& turn = all[0];
  EXPECT_EQ(turn.variable, "place, x [m]");
  ASSERT_EQ(turn.at.size(), 16u);  // half a metre each, 100 samples
  for (std::size_t k = 0; k < turn.at.size(); ++k) {
    // Half the noise of one sample in each of 100 adds up to 5 times the noise of their sum; 3.5 to either side is a
    // normal value's 1 in 2000, of 16 strips.
    EXPECT_NEAR(turn.value[k], turn.at[k] > 3.0 && turn.at[k] < 4.0 ? 5.0 : 0.0, 3.5) << turn.at[k];
    EXPECT_NEAR(turn.after[k], 0.0, 3.5);
    EXPECT_DOUBLE_EQ(turn.high[k] - turn.value[k], 2.0);
  }
}

TEST(PlaceResponse, AboutAPatchIsNoiseBeyondItsRim) {
  const Residuals patch = there_and_back(0.002), noise = there_and_back(0.0);
  const Response r = zone_response({3.5, 0.0, 0.5}, "patch", {patch}, {noise});
  ASSERT_GT(r.at.size(), 10u);
  EXPECT_LT(r.at.back(), 1.5);
  constexpr double kGathered_m = 0.25;  // half a second to either side at 0.5 m/s
  for (std::size_t k = 0; k < r.at.size(); ++k) {
    // In 50 samples as much as the noise of each adds up to seven times the noise of their sum.
    if (r.at[k] < 0.5 - kGathered_m) {
      EXPECT_GT(r.value[k], 4.0) << r.at[k];
      EXPECT_GT(r.low[k], 2.0) << r.at[k];
    }
    if (r.at[k] > 0.5 + kGathered_m) {
      EXPECT_LT(r.value[k], 2.0) << r.at[k];
    }
    EXPECT_LT(r.after[k], 2.0);
  }
  EXPECT_TRUE(zone_response({30.0, 0.0, 0.5}, "patch", {patch}, {noise}).at.empty());
}

TEST(PlaceResponse, OfWhatStaysAtOnePlaceIsNone) {
  Residuals r = there_and_back(0.0);
  for (double& x : r.x_m) x = 1.0;
  EXPECT_TRUE(place_responses({r}, {}, false).empty());
  EXPECT_TRUE(place_responses({}, {}, false).empty());
}

}  // namespace
}  // namespace odolab
