#include "core/vehicle/differential_drive.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

TEST(DifferentialDriveParameters, OfTheLabMateAreSound) {
  EXPECT_TRUE(problems_in(DifferentialDrive{}).empty());
  DifferentialDrive geared;
  geared.encoder_counts_per_revolution = 64;
  geared.gear_ratio = 43.7;
  EXPECT_NEAR(geared.counts_per_wheel_turn(), 2796.8, 1e-9);
}

TEST(DifferentialDriveParameters, AreNamedWhereTheyAreNot) {
  DifferentialDrive d;
  d.wheel_radius_left_m = 0.0;
  d.wheelbase_m = std::nan("");
  d.gear_ratio = -1.0;
  d.counter_bits = 63;
  const std::vector<std::string> problems = problems_in(d);
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_EQ(problems[0], "wheel_radius_left_m: found 0, expected a length in metres above 0");
  EXPECT_EQ(problems[1].rfind("wheelbase_m: found nan", 0), 0u);
  EXPECT_EQ(problems[2].rfind("gear_ratio: found -1", 0), 0u);
  EXPECT_EQ(problems[3], "counter_bits: found 63, expected 0 (never wraps) to 62");
}

}  // namespace
}  // namespace odolab
