#include "core/diagnosis/gathered_over.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/drive_generator.h"

namespace odolab::test {
namespace {

// Straight out for 5 m, and back.
Recording out_and_back(double truth_period_s) {
  Random random(1);
  GeneratorSettings g;
  g.duration_s = 40.0;
  g.truth_period_s = truth_period_s;
  const double radps = 0.25 / g.drive.wheel_radius_left_m;
  return generated(
      g,
      [=](double t) {
        return t < 20.0 ? WheelSpeedsAt{radps, radps} : WheelSpeedsAt{-radps, -radps};
      },
      random);
}

TEST(GatheredOver, IsTheWholeDriveWhereTheTruthIsAtItsEndsAlone) {
  const std::optional<WindowSize> whole = gathered_over({out_and_back(0.0)}, Vehicle{});
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->way_m, 10.0, 0.1);
  EXPECT_TRUE(whole->is_long());
}

// Twenty counts a turn: 24 mm of floor to a count, which come on one wheel and then on the other.
TEST(GatheredOver, IsNoTurnWhereCoarseCountsComeOnOneWheelAfterTheOther) {
  Recording coarse = out_and_back(0.05);
  for (Channel& c : coarse.channels)
    if (c.name.find("_wheel_rad") != std::string::npos)
      for (double& angle : c.values)
        if (!std::isnan(angle)) angle = kPi / 10.0 * std::floor(10.0 / kPi * angle + (c.name[0] == 'l' ? 0.0 : 0.5));
  const std::optional<WindowSize> metre = gathered_over({coarse}, Vehicle{});
  ASSERT_TRUE(metre);
  EXPECT_NEAR(metre->way_m, 1.0, 0.1);
  EXPECT_LT(metre->turn_rad, 0.5);
}

TEST(GatheredOver, IsAMetreWhereTheTruthLooksOn) {
  const std::optional<WindowSize> metre = gathered_over({out_and_back(0.05)}, Vehicle{});
  ASSERT_TRUE(metre);
  EXPECT_NEAR(metre->way_m, 1.0, 0.05);  // a window ends within a stride and a sample of its metre
  EXPECT_FALSE(metre->is_long());
}

}  // namespace
}  // namespace odolab::test
