#include "core/diagnosis/model/counts_at_rest.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

constexpr double kRestingRadius_m = 0.1, kRestingBase_m = 0.4;

DifferentialDrive drive_of_1000_counts() {
  DifferentialDrive d;
  d.wheel_radius_left_m = d.wheel_radius_right_m = kRestingRadius_m;
  d.wheelbase_m = kRestingBase_m;
  d.encoder_counts_per_revolution = 1000;
  d.gear_ratio = 1.0;
  return d;
}

// Forward, rest, backward, rest: both wheels alike, ten counts each way.
InnovationRun there_and_back_by_counts() {
  InnovationRun run;
  run.counts_show = true;
  const double count = 2.0 * kPi / 1000.0;
  double rad = 0.0;
  for (int i = 0; i <= 300; ++i) {
    if (i > 50 && i <= 60) rad += count;
    if (i > 160 && i <= 170) rad -= count;
    run.wheels.push_back({0.01 * i, rad, rad});
  }
  return run;
}

TEST(CountsAtRest, AreRegainedAtAStopAndLostAtTheNextStart) {
  const std::array<Motions, 2> of = counts_at_rest(there_and_back_by_counts(), drive_of_1000_counts());
  const double half_count_m = 0.5 * 2.0 * kPi / 1000.0 * kRestingRadius_m;
  // The axle's middle goes half as far as the wheel, and turns it by the way over the wheelbase. The reading is ahead
  // at rest, so the wheel is behind it: back at the stop, on at the start, the other way round behind a way back.
  EXPECT_NEAR(of[0][59].forward_m, -0.5 * half_count_m, 1e-15);
  EXPECT_NEAR(of[0][160].forward_m, 0.5 * half_count_m, 1e-15);
  EXPECT_NEAR(of[0][169].forward_m, 0.5 * half_count_m, 1e-15);
  EXPECT_NEAR(of[0][59].turn_rad, half_count_m / kRestingBase_m, 1e-15);
  EXPECT_NEAR(of[1][59].turn_rad, -half_count_m / kRestingBase_m, 1e-15);
  int moments = 0;
  for (std::size_t i = of[0].first(); i < of[0].end(); ++i) moments += of[0][i].forward_m != 0.0;
  EXPECT_EQ(moments, 3);
}

TEST(CountsAtRest, AreNothingWhereReadingsAreNotCounted) {
  InnovationRun run = there_and_back_by_counts();
  run.counts_show = false;
  for (const Motions& m : counts_at_rest(run, drive_of_1000_counts()))
    for (std::size_t i = m.first(); i < m.end(); ++i) EXPECT_EQ(m[i].forward_m, 0.0);
}

}  // namespace
}  // namespace odolab
