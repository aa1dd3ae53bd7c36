#include "core/diagnosis/units/component_names.h"

#include <gtest/gtest.h>

#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

TEST(Components, AreOfOneUnitOrOfAll) {
  EXPECT_EQ(component_of_unit("truck_b", "left_wheel"), "truck_b.left_wheel");
  EXPECT_EQ(component_of_unit("castor1", "vehicle"), "castor1");
  EXPECT_EQ(component_of_unit("truck_b", "floor"), "floor");
  EXPECT_EQ(component_of_unit("", "left_wheel"), "left_wheel");
  const std::vector<VehicleUnit> trucks = units_of(vehicle_of(Clapper{}));
  EXPECT_EQ(component_in_unit("truck_b", "truck_b.left_wheel", trucks), "left_wheel");
  EXPECT_EQ(component_in_unit("truck_b", "truck_b", trucks), "vehicle");
  EXPECT_EQ(component_in_unit("truck_b", "truck_a.left_wheel", trucks), std::nullopt);
  EXPECT_EQ(component_in_unit("truck_a", "floor", trucks), "floor");
}

}  // namespace
}  // namespace odolab::test
