#include "core/calibration/frozen_truth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab::test {
namespace {

const DifferentialDrive kDrive{0.1, 0.1, 0.8};

// Read twenty times a second: it rests for two seconds, then both wheels turn at such speeds.
std::vector<WheelSample> setting_off(double left_radps, double right_radps) {
  std::vector<WheelSample> wheels;
  for (int k = 0; k <= 80; ++k) {
    const double since_s = std::max(0.0, 0.05 * k - 2.0);
    wheels.push_back({0.05 * k, left_radps * since_s, right_radps * since_s});
  }
  return wheels;
}

// Four a second, to a millimetre: the same from `from_s` to `to_s`, and elsewhere never twice.
std::vector<TruthSample> the_same(double from_s, double to_s, bool has_headings) {
  std::vector<TruthSample> truth;
  for (int k = 0; k <= 16; ++k) {
    const double t = 0.25 * k;
    TruthSample s;
    s.time_s = t;
    s.position = {t >= from_s && t <= to_s ? 0.0 : 0.001 * (k % 3 + 1), 0.0};
    s.heading_rad = has_headings && (t < from_s || t > to_s) ? 0.01 * k : 0.0;
    truth.push_back(s);
  }
  return truth;
}

TEST(FrozenTruth, IsOneThatRepeatsItselfOnTheWay) {
  const TimeStretches frozen = frozen_truth(the_same(2.5, 3.25, true), setting_off(3.0, 3.0), kDrive, 0.0);
  ASSERT_EQ(frozen.size(), 1u);
  EXPECT_NEAR(frozen.front().first, 2.5, 1e-9);
  EXPECT_NEAR(frozen.front().second, 3.25, 1e-9);
}

// What turns about the tracked point leaves it where it is.
TEST(FrozenTruth, IsNoneWithoutHeadingsWhereItTurnsOnTheSpot) {
  EXPECT_TRUE(frozen_truth(the_same(2.5, 3.25, false), setting_off(-3.0, 3.0), kDrive, 0.0).empty());
  EXPECT_EQ(frozen_truth(the_same(2.5, 3.25, true), setting_off(-3.0, 3.0), kDrive, 0.0).size(), 1u);
  EXPECT_EQ(frozen_truth(the_same(2.5, 3.25, false), setting_off(3.0, 3.0), kDrive, 0.0).size(), 1u);
}

// The last sample at rest is taken just behind a reading, and the next reading is of wheels that roll.
TEST(FrozenTruth, IsNoneWhereWheelsSetOffBehindIt) {
  EXPECT_TRUE(frozen_truth(the_same(1.5, 2.0, true), setting_off(8.0, 8.0), kDrive, -0.01).empty());
}

// Two hundred times a second and to a millimetre: what creeps repeats itself for a few samples, wherever it does.
TEST(FrozenTruth, IsNotWhatCreepsWithinOneStepOfARoundedTruth) {
  const auto creeping = [](double stands_until_s) {
    std::vector<TruthSample> truth;
    for (int k = 0; k <= 800; ++k) {
      TruthSample s;
      s.time_s = 0.005 * k;
      s.position = {0.001 * std::round(100.0 * (std::max(s.time_s, stands_until_s) - 2.0)), 0.0};
      truth.push_back(s);
    }
    return truth;
  };
  EXPECT_TRUE(frozen_truth(creeping(2.0), setting_off(1.0, 1.0), kDrive, 0.0).empty());
  const TimeStretches frozen = frozen_truth(creeping(3.0), setting_off(1.0, 1.0), kDrive, 0.0);
  ASSERT_EQ(frozen.size(), 1u);
  EXPECT_NEAR(frozen.front().second, 3.0, 0.011);
}

}  // namespace
}  // namespace odolab::test
