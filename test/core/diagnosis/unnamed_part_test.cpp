#include "core/diagnosis/unnamed_part.h"

#include <gtest/gtest.h>

#include "core/diagnosis/findings_of.h"

namespace odolab {
namespace {

std::string part_said(const std::string& component, const std::string& regime, bool has_units = false) {
  Diagnosis d;
  d.findings.resize(1);
  d.findings[0].effect = "unknown";
  d.findings[0].component = component;
  d.findings[0].where.regime = regime;
  say_parts_of_unnamed(d, has_units);
  return d.findings[0].component;
}

TEST(UnnamedPart, IsTheTruthOrTheWheelInWhichItShows) {
  EXPECT_EQ(part_said("vehicle", "truth's position that depends on place on the floor"), "truth");
  EXPECT_EQ(part_said("vehicle", "truth late by [s] that depends on time, in each recording"), "truth");
  EXPECT_EQ(part_said("vehicle", "way of the left wheel per metre [1] that depends on its angle, 2 times a turn"),
            "left_wheel");
  EXPECT_EQ(part_said("vehicle", "right wheel per metre [1] that depends on its own speed [m/s]"), "right_wheel");
}

TEST(UnnamedPart, IsTheVehicleWhereItShowsInTheWholeOfIt) {
  EXPECT_EQ(part_said("vehicle", "turn per metre [rad/m] that depends on left wheel angle [rad]"), "vehicle");
  EXPECT_EQ(part_said("vehicle", "way of the left and the right wheel [s2] that depends on acceleration"), "vehicle");
  EXPECT_EQ(part_said("floor", "left wheel per metre [1] that depends on place on the floor"), "floor");
}

TEST(UnnamedPart, IsAWheelOfTheFrameThatIsMeant) {
  EXPECT_EQ(part_said("truck_b", "left wheel per metre [1] that depends on speed [m/s]", true), "truck_b.left_wheel");
  EXPECT_EQ(part_said("vehicle", "left wheel per metre [1] that depends on speed [m/s]", true), "vehicle");
  EXPECT_EQ(part_said("truck_b", "truth's position that depends on place on the floor", true), "truck_b");
}

TEST(UnnamedPart, ResemblesOnlyWhatSaysAQuarterOfIt) {
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
