#include "core/diagnosis/quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/drive_generator.h"

namespace odolab {
namespace {

// Drives for 10 s, stands for 10 s, drives on.
Recording with_a_rest(double truth_late_s = 0.0) {
  test::GeneratorSettings g;
  g.truth.time_offset_s = truth_late_s;
  g.duration_s = 30.0;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.001;
  Random random(3);
  return generated(
      g,
      [](double t) {
        const double pace = t < 10.0 || t > 20.0 ? 4.0 : 0.0;
        return test::WheelSpeedsAt{pace, 1.1 * pace};
      },
      random);
}

void freeze(Recording& r, double from_s, double to_s) {
  for (Channel& c : r.channels) {
    if (c.name.rfind("truth_", 0) != 0) continue;
    double last = 0.0;
    for (std::size_t i = 0; i < r.time_s.size(); ++i) {
      if (!std::isfinite(c.values[i])) continue;
      if (r.time_s[i] > from_s && r.time_s[i] < to_s) c.values[i] = last;
      last = c.values[i];
    }
  }
}

TEST(Checked, LeavesATruthThatRepeatsItselfAtRestAlone) {
  Recording r = with_a_rest();
  freeze(r, 14.0, 14.6);
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, TakesARestForARestWhereTheTruthIsMissingAtItsEnd) {
  Recording r = with_a_rest();
  for (Channel& c : r.channels)
    if (c.name.rfind("truth_", 0) == 0)
      for (std::size_t i = 0; i < r.time_s.size(); ++i)
        if (r.time_s[i] > 19.0 && r.time_s[i] < 22.0) c.values[i] = std::nan("");  // by 22 s it is 0.6 m further on
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, TakesARestForARestWhereTheTruthErrsOnceAtItsEnd) {
  Recording r = with_a_rest();
  for (Channel& c : r.channels)
    if (c.name == "truth_x_m")
      for (std::size_t i = 0; i < r.time_s.size(); ++i)
        if (std::abs(r.time_s[i] - 20.0) < 0.03) c.values[i] += 0.8;  // one sample
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, TakesARestForARestWhereTheTruthsClockIsLate) {
  Recording r = with_a_rest(0.4);
  EXPECT_TRUE(checked(r, Vehicle{}).faults.empty());
}

TEST(Checked, LeavesItOutAtRestTooWhereItDoesSoOnTheWay) {
  Recording r = with_a_rest();
  freeze(r, 5.0, 5.6);
  freeze(r, 14.0, 14.6);
  const CheckedRecording c = checked(r, Vehicle{});
  ASSERT_EQ(c.faults.size(), 1u);
  ASSERT_EQ(c.faults[0].time_s.size(), 2u);
  EXPECT_NEAR(c.faults[0].time_s[1].first, 14.0, 0.06);  // the truth comes every 0.05 s
  EXPECT_NEAR(c.faults[0].time_s[1].second, 14.6, 0.06);
}

TEST(Checked, TakesAnEncoderOfTwelveCountsForSoundWhereOneOfThemLasts) {
  Recording r;
  test::GeneratorSettings g;
  g.drive.encoder_counts_per_revolution = 12.0;
  g.drive.gear_ratio = 1.0;
  g.duration_s = 40.0;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.002;
  Random random(4);
  r = generated(
      g,
      [](double t) {
        return test::WheelSpeedsAt{3.0 + 2.8 * std::sin(0.5 * t), 3.0 - 2.8 * std::sin(0.5 * t)};
      },
      random);
  Vehicle vehicle;
  vehicle.kind = g.drive;
  EXPECT_TRUE(checked(r, vehicle).faults.empty());
}

}  // namespace
}  // namespace odolab
