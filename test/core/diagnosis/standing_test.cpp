#include "core/diagnosis/naming/standing.h"

#include <gtest/gtest.h>

#include "core/diagnosis/effects/effect.h"

namespace odolab {
namespace {

TEST(Standing, AsksATwentiethOfTheErrorOfWhatShowsInOnePlaceAlone) {
  constexpr double kError = 0.02;
  Effect throughout, in_one_place;
  in_one_place.local = true;
  for (const double p_value : {0.0005, 0.005, 0.05}) {
    ScoredCandidate c;
    c.p_value = p_value;
    c.test.cross_validated = 1.0;
    c.beyond_counts = true;
    c.effect = &throughout;
    EXPECT_EQ(stands(c, kError), p_value < 0.02);
    c.effect = &in_one_place;
    EXPECT_EQ(stands(c, kError), p_value < 0.001);
  }
}

}  // namespace
}  // namespace odolab
