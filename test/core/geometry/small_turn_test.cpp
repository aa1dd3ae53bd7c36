#include "core/geometry/small_turn.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

constexpr double kLastPlace = 2.2204460492503131e-16;

TEST(SmallTurn, IsAsExactAsTheLibrary) {
  for (int i = -4000; i <= 4000; ++i) {
    const double angle_rad = 1e-4 * i;  // small ones and such as are not
    const Turn turn = turn_of(angle_rad);
    // The series and the library are each within one unit of the last place.
    EXPECT_NEAR(turn.c, std::cos(angle_rad), 2.0 * kLastPlace) << angle_rad;
    EXPECT_NEAR(turn.s, std::sin(angle_rad), 2.0 * kLastPlace * std::abs(angle_rad)) << angle_rad;
  }
}

TEST(SmallTurn, TurnsFollowEachOther) {
  const Turn both = turn_of(0.2).then(turn_of(1.1));
  EXPECT_NEAR(both.c, std::cos(1.3), 4.0 * kLastPlace);  // two products and a sum round
  EXPECT_NEAR(both.s, std::sin(1.3), 4.0 * kLastPlace);
}

TEST(SmallTurn, StaysOnTheCircleWhereNothingIsKnown) {
  EXPECT_TRUE(std::isnan(turn_of(std::nan("")).c));
}

}  // namespace
}  // namespace odolab
