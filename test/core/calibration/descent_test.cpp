#include "core/calibration/descent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace odolab {
namespace {

TEST(Descent, FindsTheLeastOfAParabolaInOneStep) {
  int calls = 0;
  // (x - 1)^2 + 10 (y + 0.5)^2 + (x - 1)(y + 0.5)
  const auto parabola = [&](std::vector<double>& at) {
    ++calls;
    const double x = at[0] - 1.0, y = at[1] + 0.5;
    return Sloped{x * x + 10.0 * y * y + x * y, {2.0 * x + y, 20.0 * y + x}, {2.0, 1.0, 1.0, 20.0}};
  };
  const std::vector<double> best = descended(parabola, {0.0, 0.0});
  EXPECT_NEAR(best[0], 1.0, 1e-9);  // rounding
  EXPECT_NEAR(best[1], -0.5, 1e-9);
  EXPECT_EQ(calls, 2);  // where it starts, and where it ends
}

TEST(Descent, FollowsABentValley) {
  // H. H. Rosenbrock 1960, with the curvature of its two squares alone.
  const auto valley = [](std::vector<double>& at) {
    const double x = at[0], y = at[1], across = 10.0 * (y - x * x), along = 1.0 - x;
    return Sloped{across * across + along * along,
                  {-40.0 * across * x - 2.0 * along, 20.0 * across},
                  {800.0 * x * x + 2.0, -400.0 * x, -400.0 * x, 200.0}};
  };
  DescentLimits limits;
  limits.least_gain = 1e-12;
  const std::vector<double> best = descended(valley, {-1.2, 1.0}, limits);
  EXPECT_NEAR(best[0], 1.0, 1e-4);  // a gain of 1e-12 along a valley of curvature 0.4
  EXPECT_NEAR(best[1], 1.0, 1e-4);
}

TEST(Descent, ShortensStepsWhoseCurvatureIsFarTooSmall) {
  const auto steep = [](std::vector<double>& at) { return Sloped{100.0 * at[0] * at[0], {200.0 * at[0]}, {1.0}}; };
  DescentLimits limits;
  limits.most_calls = 1000;
  EXPECT_NEAR(descended(steep, {1.0}, limits)[0], 0.0, 0.01);  // a value of 0.01, the least gain
}

TEST(Descent, StaysWithinBoundsThatTheFunctionKeeps) {
  // Least at -1, but not below 0.25: there the slope counts as none.
  const auto bounded = [](std::vector<double>& at) {
    at[0] = std::max(at[0], 0.25);
    const double by = at[0] + 1.0;
    return Sloped{
        by * by + std::pow(at[1] - 3.0, 2), {at[0] > 0.25 ? 2.0 * by : 0.0, 2.0 * (at[1] - 3.0)}, {2.0, 0.0, 0.0, 2.0}};
  };
  const std::vector<double> best = descended(bounded, {2.0, 0.0});
  EXPECT_EQ(best[0], 0.25);
  EXPECT_NEAR(best[1], 3.0, 1e-9);  // rounding
}

}  // namespace
}  // namespace odolab
