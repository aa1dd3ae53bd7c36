#include "core/scenario/floor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace odolab {
namespace {

TEST(Shape, ContainsWhatLiesInside) {
  EXPECT_TRUE(contains(Disc{{1, 1}, 0.5}, {1.4, 1.0}));
  EXPECT_FALSE(contains(Disc{{1, 1}, 0.5}, {1.4, 1.4}));
  const Rectangle turned{{0, 0}, 2.0, 0.2, kPi / 2};  // its long side along y
  EXPECT_TRUE(contains(turned, {0.05, 0.9}));
  EXPECT_FALSE(contains(turned, {0.9, 0.05}));
}

TEST(Shape, ContainsByCrossingsWhicheverWayAPolygonRuns) {
  Polygon arrow{{{0, 0}, {2, 1}, {0, 2}, {1, 1}}};  // not convex
  for (int way = 0; way < 2; ++way) {
    EXPECT_TRUE(contains(arrow, {1.5, 1.0}));
    EXPECT_FALSE(contains(arrow, {0.5, 1.0}));  // in the notch
    std::reverse(arrow.corners.begin(), arrow.corners.end());
  }
}

TEST(Shape, ContainsWhatItDidMovedAlongWithIt) {
  for (const Shape& s :
       {Shape{Disc{{1, 2}, 1}}, Shape{Rectangle{{1, 2}, 1, 1, 0}}, Shape{Polygon{{{0, 1}, {2, 1}, {1, 3}}}}}) {
    EXPECT_TRUE(contains(s, {1.2, 2.2}));
    EXPECT_FALSE(contains(moved(s, {3, -1}), {1.2, 2.2}));
    EXPECT_TRUE(contains(moved(s, {3, -1}), {4.2, 1.2}));
  }
}

TEST(Floor, IsSoundByDefaultAndSaysWhatIsNot) {
  EXPECT_TRUE(problems_in(Floor{}).empty());
  Floor f;
  f.friction = -0.1;
  f.bumps = {Bump{}, Bump{}};
  f.bumps[1].height_m = 0.5;
  SlipZone zone;
  zone.shape = Polygon{{{0, 0}, {1, 1}}};
  zone.slip = 1.5;
  f.slip_zones = {zone};
  const std::vector<std::string> problems = problems_in(f);
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_EQ(problems[0], "floor.friction: found -0.1, expected a coefficient of 0 or more");
  EXPECT_EQ(problems[1].rfind("floor.bump[2].height_m", 0), 0u);
  EXPECT_EQ(problems[2].rfind("floor.slip_zone[1].slip", 0), 0u);
  EXPECT_EQ(problems[3].rfind("floor.slip_zone[1].corners: found 2", 0), 0u);
}

}  // namespace
}  // namespace odolab
