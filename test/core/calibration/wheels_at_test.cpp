#include "core/calibration/wheels_at.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

const std::vector<WheelSample> kReadings = {{1.0, 0.0, 4.0}, {2.0, 2.0, 3.0}, {2.5, 2.0, 7.0}};

TEST(WheelsAt, AreOnTheLineBetweenTwoReadings) {
  const WheelSample early = wheels_at(kReadings, 1.25), late = wheels_at(kReadings, 2.25);
  EXPECT_EQ(early.time_s, 1.25);
  EXPECT_EQ(early.left_rad, 0.5);
  EXPECT_EQ(early.right_rad, 3.75);
  EXPECT_EQ(late.left_rad, 2.0);
  EXPECT_EQ(late.right_rad, 5.0);
}

TEST(WheelsAt, AreAsReadAtAReadingAndRestBeyondTheEnds) {
  for (const WheelSample& reading : kReadings)
    EXPECT_EQ(wheels_at(kReadings, reading.time_s).right_rad, reading.right_rad);
  EXPECT_EQ(wheels_at(kReadings, 0.0).right_rad, 4.0);
  EXPECT_EQ(wheels_at(kReadings, 9.0).right_rad, 7.0);
}

TEST(WheelsAt, TakeTheEarliestOfReadingsAtOneTime) {
  const std::vector<WheelSample> twice = {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 5.0, 0.0}, {2.0, 6.0, 0.0}};
  EXPECT_EQ(wheels_at(twice, 1.0).left_rad, 1.0);
  EXPECT_EQ(wheels_at(twice, 1.5).left_rad, 5.5);
}

}  // namespace
}  // namespace odolab
