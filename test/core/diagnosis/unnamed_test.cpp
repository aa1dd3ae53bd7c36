#include <gtest/gtest.h>

#include "core/diagnosis/findings_of.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/units/component_names.h"

namespace odolab {
namespace {

TEST(Unnamed, IsOfTheTruthOrTheWheelInWhichItShows) {
  EXPECT_EQ(part_of_channel("truth's position"), "truth");
  EXPECT_EQ(part_of_channel("truth late by [s]"), "truth");
  EXPECT_EQ(part_of_channel("turn and shift of the truth's frame"), "truth");
  EXPECT_EQ(part_of_channel("way of the left wheel per metre [1]"), "left_wheel");
  EXPECT_EQ(part_of_channel(name_of_channel(kRightWheelAlone)), "right_wheel");
}

TEST(Unnamed, IsOfTheVehicleWhereItShowsInTheWholeOfIt) {
  for (int channel = 0; channel < kLeftWheelAlone; ++channel)
    EXPECT_EQ(part_of_channel(name_of_channel(channel)), "vehicle");
  EXPECT_EQ(part_of_channel("way of the left and the right wheel [s2]"), "vehicle");
}

TEST(Unnamed, IsOfAWheelOfTheFrameThatIsMeant) {
  EXPECT_EQ(component_of_unit("truck_b", part_of_channel(name_of_channel(kLeftWheelAlone))), "truck_b.left_wheel");
}

TEST(Unnamed, ResemblesOnlyWhatSaysAQuarterOfIt) {
  Finding unknown;
  unknown.effect = "unknown";
  unknown.log_likelihood_gain = 100.0;
  unknown.alternatives = {{"slip_zone", "floor", 24.0, ""},
                          {"wheel_eccentricity", "left_wheel", 26.0, ""},
                          {"collision", "vehicle", 13.0, ""},
                          {"collision", "vehicle", 14.0, ""}};
  leave_out_what_it_hardly_resembles(unknown);
  ASSERT_EQ(unknown.alternatives.size(), 3u);
  EXPECT_EQ(unknown.alternatives[0].effect, "wheel_eccentricity");
  EXPECT_EQ(unknown.alternatives[1].effect, "collision");  // pushes say it together
}

}  // namespace
}  // namespace odolab
