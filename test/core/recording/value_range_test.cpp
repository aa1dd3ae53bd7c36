#include "core/recording/value_range.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

TEST(ValueRange, HoldsPlacesByMapCoordinatesAndCountersOf64Bits) {
  EXPECT_GT(largest_value("truth_y_m"), 1e7);  // UTM, south of the equator
  EXPECT_GT(largest_value("left_ticks"), std::ldexp(1.0, 64));
  EXPECT_LT(largest_value("left_wheel_rad"), 1e10);
  EXPECT_LT(largest_value("command_yaw_rate_radps"), 1e7);
  EXPECT_EQ(largest_value("battery_v"), INFINITY);
}

TEST(ValueRange, NamesTheFirstValueBeyond) {
  Recording r;
  r.time_s = {0.0, 1.0};
  r.channels = {{"battery_v", {1e300, 0.0}}, {"truth_x_m", {std::nan(""), -1e200}}};
  ASSERT_TRUE(value_beyond_range(r));
  EXPECT_EQ(value_beyond_range(r)->message(),
            "truth_x_m: found -1e+200 in row 2, expected a number from -1e+08 to 1e+08 (m)");
  r.channels[1].values[1] = -9e6;
  EXPECT_FALSE(value_beyond_range(r));
}

}  // namespace
}  // namespace odolab
