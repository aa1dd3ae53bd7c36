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

}  // namespace
}  // namespace odolab
