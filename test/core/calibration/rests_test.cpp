#include "core/calibration/rests.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

TEST(Rests, HaveAnEdgeAtEachEndAndKnowTheWayBefore) {
  std::vector<WheelSample> readings;
  double rad = 0.0;
  for (int i = 0; i <= 300; ++i) {
    if (i > 50 && i <= 60) rad += 0.01;
    if (i > 160 && i <= 170) rad -= 0.01;
    readings.push_back({0.01 * i, rad, 0.0});
  }
  const std::vector<RestEdge> edges = rest_edges(readings, &WheelSample::left_rad);
  ASSERT_EQ(edges.size(), 3u);  // the rest before the first movement has none, the last one no end
  EXPECT_EQ(edges[0].interval, 59);
  EXPECT_FALSE(edges[0].sets_off);
  EXPECT_EQ(edges[0].direction, 1.0);
  EXPECT_EQ(edges[1].interval, 160);
  EXPECT_TRUE(edges[1].sets_off);
  EXPECT_EQ(edges[1].direction, 1.0);
  EXPECT_EQ(edges[2].interval, 169);
  EXPECT_EQ(edges[2].direction, -1.0);
  EXPECT_TRUE(rest_edges(readings, &WheelSample::right_rad).empty());
}

TEST(Rests, AreNoWaitingForTheNextCount) {
  std::vector<WheelSample> readings;
  for (int i = 0; i <= 300; ++i) readings.push_back({0.01 * i, 0.01 * (i / 15), 0.0});  // a count each 0.15 s
  EXPECT_TRUE(rest_edges(readings, &WheelSample::left_rad).empty());
}

TEST(Rests, AreNoWaitingOfAWheelThatTurnsSlowerThanItsCountsComeForAWhile) {
  std::vector<WheelSample> readings;
  const auto turned = [](double t) { return t < 2.0 ? t : t < 2.9 ? 2.0 : t - 0.9; };  // rests for 0.9 s
  for (int i = 0; i <= 500; ++i) readings.push_back({0.01 * i, 0.4 * std::floor(turned(0.01 * i) / 0.4 + 0.5), 0.0});
  const std::vector<RestEdge> edges = rest_edges(readings, &WheelSample::left_rad);  // a count each 0.4 s
  ASSERT_EQ(edges.size(), 3u);                                                       // the last is the end
  EXPECT_NEAR(readings[static_cast<std::size_t>(edges[0].interval)].time_s, 1.8, 0.02);
  EXPECT_FALSE(edges[0].sets_off);
  EXPECT_NEAR(readings[static_cast<std::size_t>(edges[1].interval)].time_s, 3.1, 0.02);
  EXPECT_TRUE(edges[1].sets_off);
}

}  // namespace
}  // namespace odolab
