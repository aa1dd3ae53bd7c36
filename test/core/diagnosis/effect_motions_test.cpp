#include "core/diagnosis/effects/effect_motions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

// Turns evenly at a rate that its wheels promise.
DriveView turning_at(double yaw_rate_radps) {
  DriveView view;
  view.drive = {0.05, 0.05, 0.3};
  for (int i = 0; i < 200; ++i) {
    EffectStep s;
    s.duration_s = 0.02;
    s.time_s = 0.02 * i + 0.01;
    s.speed_mps = 0.4;
    s.yaw_rate_radps = yaw_rate_radps;
    s.turn_rad = yaw_rate_radps * s.duration_s;
    view.steps.push_back(s);
  }
  return view;
}

// What turns short by k w of the turn that its wheels promise, w being the rate at which it does turn, turns at
// w = w0 (1 - k w): at w0 / (1 + k w0), and not at w0 (1 - k w0).
TEST(EffectMotions, AreThoseOfTheTurnThatIsDriven) {
  constexpr double kShort = 0.15, kByWheels = 1.2;
  const DriveView view = as_it_goes(turning_at(kByWheels), [](const DriveView& v) {
    std::vector<BodyMotion> by;
    for (const EffectStep& s : v.steps) by.push_back({0.0, 0.0, -kShort * s.yaw_rate_radps * s.turn_rad});
    return by;
  });
  for (const EffectStep& s : view.steps) {
    EXPECT_NEAR(s.yaw_rate_radps, kByWheels / (1.0 + kShort * kByWheels), 1e-3);  // as far as it is iterated
    EXPECT_NEAR(s.speed_mps, 0.4, 1e-12);
  }
}

// One that feeds back on itself with a gain of two has no such rate: it stays within half of a rim's speed.
TEST(EffectMotions, ChangeNoSpeedByMoreThanHalfOfARims) {
  const DriveView view = as_it_goes(turning_at(1.0), [](const DriveView& v) {
    std::vector<BodyMotion> by;
    for (const EffectStep& s : v.steps) by.push_back({2.0 * s.speed_mps * s.duration_s, 0.0, 0.0});
    return by;
  });
  for (const EffectStep& s : view.steps) EXPECT_LE(s.speed_mps, 0.4 + 0.5 * (0.4 + 0.15 * 1.0) + 1e-12);
}

// Of a wheel that turns at 5 rad/s above 4 a fifth of the counts is lost: it is read at 4 rad/s, and what is missing is
// a quarter of that.
TEST(EffectMotions, AddWhatAnEncoderLostOfWhatThereWas) {
  DriveView view;
  view.drive = {0.05, 0.05, 0.3};
  for (const double read_radps : {3.1, 3.3}) {
    EffectStep s;
    s.duration_s = 0.02;
    s.left_radps = read_radps;
    s.left_m = 0.05 * read_radps * s.duration_s;
    view.steps.assign(50, s);
    const std::vector<BodyMotion> sum =
        motions_of(view, {{"encoder_missed_counts", "left_wheel", {{"fraction", 0.2}, {"above_radps", 4.0}}}});
    const double missing_m = read_radps > 0.8 * 4.0 ? 0.25 * s.left_m : 0.0;
    for (const BodyMotion& m : sum) EXPECT_NEAR(m.forward_m, 0.5 * missing_m, 1e-15) << read_radps;
  }
}

TEST(EffectMotions, OfABumpAreNoneOnceTheDriveIsOver) {
  DriveView view = turning_at(0.0);
  for (EffectStep& s : view.steps) s.left_m = s.right_m = 0.008;
  const auto turned = [&](double at_s) {
    double sum_rad = 0.0;
    for (const BodyMotion& m : motions_of(view, {{"bump", "left_wheel", {{"extra_distance_m", 0.01}, {"at_s", at_s}}}}))
      sum_rad += m.turn_rad;
    return sum_rad;
  };
  EXPECT_GT(std::abs(turned(2.0)), 0.01);
  EXPECT_EQ(turned(500.0), 0.0);
}

}  // namespace
}  // namespace odolab
