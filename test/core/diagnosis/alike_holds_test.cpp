#include "core/diagnosis/quality/alike_holds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

constexpr double kHeldReading_s = 0.04, kHeldCount_rad = 0.007;

// Both wheels go fast and slow by turns, in whole counts; the left one's readings hold for so long at each of these
// times, and what it turns meanwhile is lost.
std::vector<WheelSample> wheels_held_at(const std::vector<double>& at_s, double lasts_s) {
  std::vector<WheelSample> wheels;
  double left_rad = 0.0, right_rad = 0.0;
  const auto counted = [](double rad) { return kHeldCount_rad * std::floor(rad / kHeldCount_rad); };
  for (int i = 0; i <= 1500; ++i) {
    const double t = kHeldReading_s * i;
    bool holds = false;
    for (const double from_s : at_s) holds = holds || (t > from_s && t < from_s + lasts_s - 1e-6);
    if (!holds) left_rad += kHeldReading_s * (1.5 + std::sin(0.5 * t));
    right_rad += kHeldReading_s * 3.0;
    wheels.push_back({t, counted(left_rad), counted(right_rad)});
  }
  return wheels;
}

KnownHolds known_of(const std::vector<WheelSample>& wheels, const std::vector<double>& at_s, double lasts_s) {
  TimeStretches faults;
  for (const double t : at_s) faults.emplace_back(t - 0.01, t + lasts_s + 0.01);
  KnownHolds known;
  known.add(faults, wheels, Wheel::left);
  return known;
}

TEST(AlikeHolds, AreFoundWhereTheWheelIsSlowAndAreKnownFromWhereItIsFast) {
  const std::vector<WheelSample> wheels = wheels_held_at({4.0, 14.0, 28.0, 36.0}, 0.28);
  const KnownHolds known = known_of(wheels, {4.0, 14.0, 28.0}, 0.28);
  EXPECT_EQ(known.times, 3);
  const TimeStretches found = holds_alike(wheels, Wheel::left, known);
  ASSERT_EQ(found.size(), 4u);  // those that are known among them
  EXPECT_DOUBLE_EQ(found[3].first, 36.0);
  EXPECT_DOUBLE_EQ(found[3].second, 36.28);
}

TEST(AlikeHolds, AreNoneWhereFewAreKnownOrTheseAreNotAlike) {
  const std::vector<WheelSample> wheels = wheels_held_at({4.0, 14.0, 28.0, 36.0}, 0.28);
  EXPECT_TRUE(holds_alike(wheels, Wheel::left, known_of(wheels, {4.0, 14.0}, 0.28)).empty());
  KnownHolds known = known_of(wheels, {4.0, 14.0, 28.0}, 0.28);
  known.longest_s = 0.8;
  EXPECT_TRUE(holds_alike(wheels, Wheel::left, known).empty());
}

TEST(AlikeHolds, AreOfTheirOwnLengthAndNotOfAVehicleThatStands) {
  const std::vector<WheelSample> wheels = wheels_held_at({4.0, 14.0, 28.0}, 0.28);
  const KnownHolds known = known_of(wheels, {4.0, 14.0, 28.0}, 0.28);
  EXPECT_TRUE(holds_alike(wheels_held_at({36.0}, 0.48), Wheel::left, known).empty());
  std::vector<WheelSample> stands = wheels_held_at({36.0}, 0.28);
  for (WheelSample& w : stands) w.right_rad = w.left_rad;
  EXPECT_TRUE(holds_alike(stands, Wheel::left, known).empty());
  EXPECT_EQ(holds_alike(wheels_held_at({36.0}, 0.28), Wheel::left, known).size(), 1u);
}

// What crawls from count to count holds between all of them.
TEST(AlikeHolds, AreNoneOfAWheelThatCrawls) {
  const std::vector<WheelSample> wheels = wheels_held_at({4.0, 14.0, 28.0}, 0.28);
  const KnownHolds known = known_of(wheels, {4.0, 14.0, 28.0}, 0.28);
  std::vector<WheelSample> crawls;
  for (int i = 0; i <= 1500; ++i) crawls.push_back({kHeldReading_s * i, kHeldCount_rad * std::floor(i / 7.0), 0.1 * i});
  EXPECT_TRUE(holds_alike(crawls, Wheel::left, known).empty());
}

}  // namespace
}  // namespace odolab
