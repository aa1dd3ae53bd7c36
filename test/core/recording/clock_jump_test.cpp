#include "core/recording/clock_jump.h"

#include <gtest/gtest.h>

#include "core/recording/recording.h"

namespace odolab {
namespace {

constexpr double kHour_s = 3600.0;

// A minute at 20 Hz, all of it behind the first second moved.
std::vector<double> moved_s(double by_s, double unit = 1.0) {
  std::vector<double> time_s;
  for (int i = 0; i < 1200; ++i) time_s.push_back(unit * (0.05 * i + (i < 20 ? 0.0 : by_s)));
  return time_s;
}

TEST(ClockJump, IsMoreThanADayAndAPauseOfHoursIsNone) {
  EXPECT_FALSE(first_after_jump(moved_s(0.0)));
  EXPECT_FALSE(first_after_jump(moved_s(20.0 * kHour_s)));
  EXPECT_EQ(first_after_jump(moved_s(25.0 * kHour_s)), std::optional<std::size_t>(20));
  EXPECT_EQ(first_after_jump({0.0, 1.7e9}), std::optional<std::size_t>(1));
  EXPECT_FALSE(first_after_jump({1.7e9}));
}

TEST(ClockJump, IsNotSoughtInStampsOfAnotherUnit) {
  EXPECT_FALSE(first_after_jump(moved_s(kHour_s, 1e3)));
  EXPECT_FALSE(first_after_jump(moved_s(0.0, 1e9)));
}

TEST(ClockJump, IsTheSameOfTimesThatComeOneByOne) {
  for (const double by_s : {0.0, 20.0 * kHour_s, 25.0 * kHour_s, 1.7e9})
    for (const double unit : {1.0, 1e3, 1e9}) {
      const std::vector<double> time_s = moved_s(by_s, unit);
      JumpWatch watch;
      for (double t : time_s) watch.add(t);
      EXPECT_EQ(watch.is_one_clock(), !first_after_jump(time_s)) << by_s << " " << unit;
    }
}

TEST(ClockJump, IsAProblemOfARecording) {
  Recording recording;
  recording.time_s = {0.0, 1.7e9, 1.7e9 + 0.05};
  EXPECT_EQ(problems_in(recording), std::vector<std::string>{"time_s: found 1700000000 after 0 in row 2, expected " +
                                                             std::string(kRowsOfOneClock)});
}

}  // namespace
}  // namespace odolab
