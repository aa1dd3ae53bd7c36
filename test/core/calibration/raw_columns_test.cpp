#include "core/calibration/raw_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace odolab {
namespace {

// Ticks of a wheel that turns 400 counts a second to and fro, 50 readings a second.
Recording counted(int seconds, int counter_bits = 0) {
  Recording r;
  r.name = "run.csv";
  std::vector<double> ticks;
  double count = 0.0;
  for (int i = 0; i < 50 * seconds; ++i) {
    r.time_s.push_back(0.02 * i);
    count += i < 40 * seconds ? 8.0 : -8.0;
    const double range = std::ldexp(1.0, counter_bits);
    ticks.push_back(counter_bits == 0 ? count : count - range * std::floor(count / range));
  }
  r.add_channel("left_ticks").values = ticks;
  return r;
}

void stretch_times(Recording& r, double by) {
  for (double& t : r.time_s) t *= by;
}

TEST(RawColumns, NameTheUnitThatStampsLookLike) {
  EXPECT_FALSE(stamps_in_no_seconds(counted(10)));
  for (const auto& [by, unit] : {std::pair{1e3, "milliseconds"}, {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
    Recording r = counted(10);
    stretch_times(r, by);
    const std::optional<Error> error = stamps_in_no_seconds(r);
    ASSERT_TRUE(error) << unit;
    EXPECT_NE(error->found.find(unit), std::string::npos) << error->message();
  }
}

TEST(RawColumns, AreSecondsWhereARobotWasMeasuredAtItsStartAndEndAlone) {
  Recording r = counted(10);
  r.time_s = {0.0, 40.0};
  for (Channel& c : r.channels) c.values.resize(2);
  EXPECT_FALSE(stamps_in_no_seconds(r));
}

TEST(RawColumns, TellHowManyBitsACounterHasThatWrapsWithoutAWord) {
  DifferentialDrive drive;
  EXPECT_FALSE(unknown_wrap(counted(60), drive));
  for (const int bits : {8, 10, 12}) {
    const std::optional<Error> error = unknown_wrap(counted(60, bits), drive);
    ASSERT_TRUE(error) << bits;
    EXPECT_NE(error->expected.find("counter_bits = " + std::to_string(bits) + " "), std::string::npos)
        << error->message();
  }
  drive.counter_bits = 12;
  EXPECT_FALSE(unknown_wrap(counted(60, 12), drive));
}

// A counter that starts anew after a loss of power does not go on at its pace.
TEST(RawColumns, TakeACounterThatFallsToNothingForNoWrap) {
  Recording r = counted(60);
  std::vector<double>& ticks = r.channels.front().values;
  const double lost = ticks[800];
  for (std::size_t i = 800; i < ticks.size(); ++i) ticks[i] -= lost;
  for (double& t : ticks) t = std::clamp(t, 0.0, lost);
  EXPECT_FALSE(unknown_wrap(r, DifferentialDrive{}));
}

// The first of two losses is no pace, by which the second would be within a few readings of 2^13.
TEST(RawColumns, TakeACounterThatStartsAnewTwiceForNoWrap) {
  Recording r = counted(15);
  std::vector<double>& ticks = r.channels.front().values;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double on = 10.0 * static_cast<double>(i);
    ticks[i] = i < 400 ? on : i < 740 ? on - 4000.0 : on - 11400.0;
  }
  EXPECT_FALSE(unknown_wrap(r, DifferentialDrive{}));
}

}  // namespace
}  // namespace odolab
