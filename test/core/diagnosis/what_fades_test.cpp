#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/generic/groups.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// Grease that is cold at first: the left wheel creeps until it is warm, in each run anew. No load and no drift do that.
TEST(WhatFades, CallsAWheelThatWarmsUpUnknownAndSaysThatItFadesFromTheStart) {
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0005, 0.02);
  g.duration_s = 60.0;
  const auto cold = [](int) {
    return [t_s = 0.0](test::InjectedStep& s) mutable {
      t_s += s.dt_s;
      s.left_m *= 1.0 - 0.02 * std::exp(-t_s / 7.0);
    };
  };
  Random random(67);
  const auto driving = [&](int) { return test::varied_driving(random, g.duration_s); };
  const Result<Diagnosis> d = diagnose(test::three_runs(g, random, driving, cold), {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  const std::string& regime = d->findings.front().where.regime;
  EXPECT_NE(regime.find("time since the start, forgotten"), std::string::npos) << regime;
}

// Castors that swing round after each change between forwards and reverse, and drag on for half a metre: to the left
// when it goes on forwards as in reverse, and back before it stands again.
TEST(WhatFades, CallsWhatFadesBehindAChangeOfDirectionUnknownAndSaysThatItGoesWithTheWaySince) {
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01);
  g.duration_s = 60.0;
  const auto drags = [](int) {
    return [sign = 0.0, rolled_m = 1e3](test::InjectedStep& s) mutable {
      const double way_m = 0.5 * (s.left_m + s.right_m);
      if (way_m * sign < 0.0) rolled_m = 0.0;
      if (way_m != 0.0) sign = way_m > 0.0 ? 1.0 : -1.0;
      rolled_m += std::abs(way_m);
      s.sideways_m += 0.03 * std::abs(way_m) * std::exp(-rolled_m / 0.5);
    };
  };
  const auto shuttling = [](int run) {
    return [run](double t) {
      const double pace = 5.0 * std::sin(2.0 * kPi * t / (6.0 + run)), turn = 0.2 * std::sin(0.9 * t + run);
      return test::WheelSpeedsAt{pace * (1.0 - turn), pace * (1.0 + turn)};
    };
  };
  Random random(65);
  const Result<Diagnosis> d = diagnose(test::three_runs(g, random, shuttling, drags), {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  const std::string& regime = d->findings.front().where.regime;
  EXPECT_NE(regime.find("sideways"), std::string::npos) << regime;
  EXPECT_NE(regime.find("way since it reversed"), std::string::npos) << regime;
}

}  // namespace
}  // namespace odolab
