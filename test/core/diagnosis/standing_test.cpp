#include "core/diagnosis/naming/standing.h"

#include <gtest/gtest.h>

#include "core/diagnosis/effects/effect.h"

namespace odolab {
namespace {

TEST(Standing, LeavesOverWhatIsChanceAndOfWhatShowsInOnePlaceATwentiethOfTheError) {
  constexpr double kError = 0.02;
  Effect throughout, in_one_place;
  in_one_place.local = true;
  for (const double p_value : {0.0005, 0.005, 0.6}) {
    ScoredCandidate c;
    c.p_value = p_value;
    c.effect = &throughout;
    EXPECT_EQ(is_left_over(c, kError), p_value > 0.5);
    c.effect = &in_one_place;
    EXPECT_EQ(is_left_over(c, kError), p_value > 0.001);
  }
}

}  // namespace
}  // namespace odolab
