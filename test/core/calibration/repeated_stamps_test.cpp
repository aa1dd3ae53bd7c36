#include "core/calibration/repeated_stamps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/calibration/evened_recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {
namespace {

using Times = std::vector<double>;

TEST(RepeatedStamps, ArePutIntoTheGapBehindThemOrThatBefore) {
  const auto behind = spread_repeated({0.0, 1.0, 2.0, 2.0, 4.0, 5.0, 6.0});
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->time_s, (Times{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
  EXPECT_EQ(behind->repeated, 1);
  const auto before = spread_repeated({0.0, 1.0, 2.0, 5.0, 5.0, 5.0, 6.0, 7.0});
  ASSERT_TRUE(before);
  EXPECT_EQ(before->time_s, (Times{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}));
  EXPECT_EQ(before->repeated, 2);
}

TEST(RepeatedStamps, StayWhereNoGapHasRoomForThem) {
  EXPECT_FALSE(spread_repeated({0.0, 1.0, 2.0, 3.0, 4.0}));
  EXPECT_FALSE(spread_repeated({0.0, 1.0, 1.0, 2.0, 3.0}));            // a row that was written twice
  EXPECT_FALSE(spread_repeated({0.0, 0.0, 3.0, 3.0, 6.0, 6.0, 9.0}));  // packets, of which all are
  EXPECT_FALSE(spread_repeated({}));
}

// Stamps that tremble are those of the sampling; of two readings of one stamp the second was taken a period later.
TEST(RepeatedStamps, GiveNoWheelASpeedThatItHadNot) {
  constexpr double kPeriod_s = 0.02, kSpeed_radps = 5.0, kTrembling_s = 0.004;
  Recording recording;
  for (const char* wheel : {"left_wheel_rad", "right_wheel_rad"}) recording.add_channel(wheel);
  for (int i = 0; i < 1000; ++i) {
    const double at_s = i * kPeriod_s + kTrembling_s * std::sin(2.4 * i);
    recording.time_s.push_back(i % 100 == 50 ? recording.time_s.back() : at_s);
    for (Channel& c : recording.channels) c.values.push_back(kSpeed_radps * at_s);
  }
  const auto put_apart = evened(recording, DifferentialDrive{});
  ASSERT_TRUE(put_apart);
  ASSERT_EQ(put_apart->said.size(), 1u);
  EXPECT_NE(put_apart->said[0].find("10 of its encoder stamps repeat the one before"), std::string::npos);
  const std::vector<double>& time_s = put_apart->recording.time_s;
  const std::vector<double>& turned_rad = put_apart->recording.channels[0].values;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double speed_radps = (turned_rad[i] - turned_rad[i - 1]) / (time_s[i] - time_s[i - 1]);
    EXPECT_NEAR(speed_radps, kSpeed_radps, kSpeed_radps * 3.0 * kTrembling_s / kPeriod_s) << i;
  }
}

}  // namespace
}  // namespace odolab
