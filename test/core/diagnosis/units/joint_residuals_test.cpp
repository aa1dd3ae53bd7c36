#include "core/diagnosis/units/joint_residuals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/support/crooked_vehicles.h"

namespace odolab::test {
namespace {

TEST(ErringJoint, IsTheEncoderThatWobblesAsItTurns) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  std::vector<Recording> runs = clapper_runs(trucks, {}, 241);
  EXPECT_FALSE(erring_joint(joined(runs, vehicle), {0.0, 0.0, 0.0}, vehicle, 1));
  for (Recording& r : runs) wobble(r, 0.008);
  const std::optional<ErringJoint> erring = erring_joint(joined(runs, vehicle), {0.0, 0.0, 0.0}, vehicle, 1);
  ASSERT_TRUE(erring);
  EXPECT_EQ(erring->joint, 0u);
  EXPECT_LT(erring->size, 0.008);  // root mean square of a wave of 8 mrad
  EXPECT_GT(erring->size, 0.002);
  EXPECT_LT(erring->left_out_ratio, 0.9);
}

TEST(ErringJoint, IsThePivotWhoseEncoderHasPlay) {
  const MultiCastor platform = three_castor_vehicle();
  const Vehicle vehicle = vehicle_of(platform);
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 3; ++k) runs.push_back(castor_run(platform, {}, 251 + k));
  EXPECT_FALSE(erring_joint(joined(runs, vehicle), {0.0, 0.0, 0.0}, vehicle, 1));
  constexpr double kPlay_rad = 0.04;
  for (Recording& r : runs)
    for (Channel& c : r.channels)
      if (c.name == "castor2_pivot_rad") {
        double shown = c.values[0];
        for (double& reading : c.values) {
          shown = std::clamp(shown, reading - 0.5 * kPlay_rad, reading + 0.5 * kPlay_rad);
          reading = shown;
        }
      }
  const std::optional<ErringJoint> erring = erring_joint(joined(runs, vehicle), {0.0, 0.0, 0.0}, vehicle, 1);
  ASSERT_TRUE(erring);
  EXPECT_EQ(erring->joint, 1u);
  EXPECT_NEAR(erring->play, kPlay_rad, 0.25 * kPlay_rad);  // on the way from one side to the other it is neither
}

}  // namespace
}  // namespace odolab::test
