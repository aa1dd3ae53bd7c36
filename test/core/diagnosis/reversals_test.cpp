#include "core/diagnosis/effects/reversals.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

// Steps straight on, so long each.
DriveView steps_of(const std::vector<double>& metres) {
  DriveView view;
  for (const double m : metres) {
    EffectStep s;
    s.left_m = s.right_m = m;
    view.steps.push_back(s);
  }
  return view;
}

TEST(Reversals, AreNoneInADriveThatOnlyGoesOneWayHoweverLongItsSteps) {
  for (const double step_m : {0.004, 0.02, -0.02, 0.3, -0.3})
    EXPECT_TRUE(reversals(steps_of(std::vector<double>(20, step_m))).empty()) << step_m;
}

TEST(Reversals, BeginWhereItWasFurthestAndCountOnceACentimetreBack) {
  const std::vector<Reversal> found =
      reversals(steps_of({0.02, 0.02, 0.02, -0.004, -0.004, -0.004, -0.02, 0.03, 0.03}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].first, 3u);
  EXPECT_EQ(found[0].sure, 5u);
  EXPECT_EQ(found[0].direction, -1);
  EXPECT_NEAR(found[0].back_m, 0.012, 1e-12);
  EXPECT_EQ(found[1].first, 7u);
  EXPECT_EQ(found[1].sure, 7u);
  EXPECT_EQ(found[1].direction, 1);
}

TEST(Reversals, AreNoneWhereAVehicleTremblesByLessThanACentimetre) {
  EXPECT_TRUE(reversals(steps_of({0.02, -0.004, 0.004, -0.008, 0.008, 0.02})).empty());
}

}  // namespace
}  // namespace odolab
