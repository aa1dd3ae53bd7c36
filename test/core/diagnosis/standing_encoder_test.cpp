#include "core/diagnosis/quality/standing_encoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace odolab {
namespace {

constexpr DifferentialDrive kStandingDrive{0.07, 0.07, 0.3};
constexpr double kStandingCount_rad = 2.0 * kPi / 2000.0;

// At 50 Hz for 4 s, after a first count both wheels at 14 in each interval; the left one as `left` makes it, in counts.
template <typename Left>
std::vector<WheelSample> driven_by_left(const Left& left) {
  std::vector<WheelSample> wheels{{-0.02, -kStandingCount_rad, -kStandingCount_rad}};
  for (int i = 0; i < 200; ++i)
    wheels.push_back({0.02 * i, kStandingCount_rad * left(i), kStandingCount_rad * 14.0 * i});
  return wheels;
}

// Seven intervals of which the counts never come back.
double halts(int i) { return 14.0 * (i < 100 ? i : i < 107 ? 100 : i - 7); }

TEST(HaltingEncoder, IsFoundThoughItStandsForAMomentAlone) {
  const TimeStretches found = halting_encoder(driven_by_left(halts), Wheel::left, kStandingDrive);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].first, 2.0, 1e-9);
  EXPECT_NEAR(found[0].second, 2.16, 1e-9);
  EXPECT_TRUE(halting_encoder(driven_by_left(halts), Wheel::right, kStandingDrive).empty());
}

// From 0.15 to 0.35 m/s in half a second, and two intervals of it are not counted.
TEST(HaltingEncoder, IsFoundInTwoIntervalsWhileTheWheelSpeedsUp) {
  const auto speeds_up = [](int i) {
    const double t = std::clamp(i - 90, 0, 25);
    return std::floor(14.0 * i + 0.36 * t * t + 18.0 * std::max(0, i - 115));
  };
  const auto found =
      halting_encoder(driven_by_left([&](int i) {
                        return i < 103 ? speeds_up(i) : speeds_up(std::max(i, 105)) - speeds_up(105) + speeds_up(103);
                      }),
                      Wheel::left, kStandingDrive);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].first, 2.06, 1e-9);
  EXPECT_NEAR(found[0].second, 2.12, 1e-9);
  EXPECT_TRUE(halting_encoder(driven_by_left(speeds_up), Wheel::left, kStandingDrive).empty());
}

// 0.16 m/s is gone and back within a quarter of a second each, at 0.6 m/s2.
TEST(HaltingEncoder, IsNoneWhereAWheelIsBrakedAndSpedUpAgain) {
  double at = 0.0;
  std::vector<double> counts;
  for (int i = 0; i < 200; ++i) {
    const double from_halt = std::abs(i - 103.5) - 3.5;
    at += std::round(14.0 * std::clamp(from_halt / 12.0, 0.0, 1.0));
    counts.push_back(at);
  }
  EXPECT_TRUE(halting_encoder(driven_by_left([&](int i) { return counts[static_cast<std::size_t>(i)]; }), Wheel::left,
                              kStandingDrive)
                  .empty());
}

TEST(HaltingEncoder, IsNoneWhereTheOtherWheelHaltsAsWell) {
  std::vector<WheelSample> wheels = driven_by_left(halts);
  for (WheelSample& w : wheels) w.right_rad = w.left_rad;
  EXPECT_TRUE(halting_encoder(wheels, Wheel::left, kStandingDrive).empty());
}

// A driver that asks more often than the encoder answers: each count is read five times and then comes at once.
TEST(HaltingEncoder, IsNoneWhereReadingsAreRepeated) {
  EXPECT_TRUE(
      halting_encoder(driven_by_left([](int i) { return 14.0 * (i - i % 5); }), Wheel::left, kStandingDrive).empty());
}

// Lanes at a pace that comes and goes, seen five times a second; both encoders are silent for 0.4 s. What a changing
// pace leaves in the truth along the lanes is no noise of it, wherever these lead.
TEST(StandingEncoder, IsFoundHoweverTheRoomIsTurned) {
  const auto way_m = [](double t) { return 0.3 * t - 0.1 * std::cos(2.0 * t); };
  const auto found = [&](double silent_s, double lanes_rad) {
    std::vector<WheelSample> wheels;
    for (int i = 0; i <= 1000; ++i) {
      const double t = 0.02 * i, read_s = t > silent_s && t <= silent_s + 0.4 ? silent_s : t;
      const double counts = std::floor(way_m(read_s) / kStandingDrive.wheel_radius_left_m / kStandingCount_rad);
      wheels.push_back({t, kStandingCount_rad * counts, kStandingCount_rad * counts});
    }
    std::vector<TruthSample> truth;
    for (int i = 0; i <= 100; ++i)
      truth.push_back({0.2 * i, rotated({way_m(0.2 * i), 0.001 * std::sin(9.0 * i * i)}, lanes_rad), lanes_rad});
    Vehicle vehicle;
    vehicle.kind = kStandingDrive;
    return standing_encoder(wheels, Wheel::left, truth, vehicle).size();
  };
  for (const double lanes_rad : {0.0, 0.7, 0.5 * kPi, 2.0})
    for (const double silent_s : {5.0, 6.0, 7.0, 8.0, 9.0, 10.0})
      EXPECT_EQ(found(silent_s, lanes_rad), 1u) << lanes_rad << " at " << silent_s;
}

// Both wheels stand after a few counts; the left count goes back by a tenth of a turn, once in one reading and once
// over a fifth of a second, as where somebody nudges it.
// A wheel that rolls out, rests, sets off by five counts at once and goes back: what was read at its last count is no
// pace that it kept.
TEST(CatchingUpEncoder, IsNoneWhereAWheelSetsOffAndTurnsBack) {
  const auto sets_off = [](int i) {
    constexpr double kOff[] = {5.0, 10.0, 13.0, 14.0, 11.0, 4.0, -8.0};
    return i < 60 ? 4.0 * i : i < 64 ? 240.0 + i - 60 : i < 100 ? 244.0 : 244.0 + kOff[std::min(i - 100, 6)];
  };
  EXPECT_TRUE(catching_up_encoder(driven_by_left(sets_off), Wheel::left).empty());
  const auto catches_up = [](int i) { return i < 60 || i > 100 ? 4.0 * i : 240.0; };
  EXPECT_EQ(catching_up_encoder(driven_by_left(catches_up), Wheel::left).size(), 1u);
}

TEST(MovedAtRest, IsACounterThatNobodyNudges) {
  const auto resting = [](double takes_s) {
    std::vector<WheelSample> wheels;
    for (int i = 0; i <= 100; ++i) {
      const double t = 0.02 * i, back = std::clamp((t - 1.0) / takes_s, 0.0, 1.0);
      const double counted = std::min(i, 10);
      wheels.push_back({t, std::round(counted - 60.0 * back) / 100.0, counted / 100.0});
    }
    return wheels;
  };
  const TimeStretches found = moved_at_rest(resting(0.01), Wheel::left);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].first, 1.0, 1e-9);
  EXPECT_NEAR(found[0].second, 1.02, 1e-9);
  EXPECT_TRUE(moved_at_rest(resting(0.2), Wheel::left).empty());
  EXPECT_TRUE(moved_at_rest(resting(0.01), Wheel::right).empty());
}

}  // namespace
}  // namespace odolab
