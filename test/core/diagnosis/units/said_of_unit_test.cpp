#include <gtest/gtest.h>

#include "core/diagnosis/units/merged.h"

namespace odolab {
namespace {

TEST(SaidOfUnit, TellsWhatStandsForTheTruthOfAUnitThatDoesNotCarryIt) {
  VehicleUnit truck;
  truck.name = "truck_b";
  const std::string warning = "run_1.csv: from 21.76 to 22.52 s the truth is elsewhere";
  EXPECT_EQ(said_of_unit(warning, truck, OutsideTruth::poses),
            "truck B (its truth is told through the joints): " + warning);
  for (const OutsideTruth less : {OutsideTruth::positions, OutsideTruth::ends, OutsideTruth::nothing})
    EXPECT_EQ(said_of_unit(warning, truck, less),
              "truck B (its truth is the way of the other units, through the joints): " + warning);
  EXPECT_EQ(said_of_unit("its counts are coarse", truck, OutsideTruth::nothing), "truck B: its counts are coarse");
  truck.carries_truth = true;
  EXPECT_EQ(said_of_unit(warning, truck, OutsideTruth::poses), "truck B: " + warning);
  EXPECT_EQ(said_of_unit(warning, {}, OutsideTruth::poses), warning);
}

}  // namespace
}  // namespace odolab
